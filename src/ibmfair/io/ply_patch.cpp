// Copies a PLY file, changes only the coordinates of moved vertices and the values that depend on
// them, and inserts new rows after its vertices and after its faces.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_append.h"
#include "ibmfair/io/ply_body.h"
#include "ibmfair/io/precision.h"

namespace ibmfair::ply {
namespace {

/// How to write a vertex property.
struct Treatment {
  enum class Kind : std::uint8_t { copy, position, normal, drop } kind = Kind::copy;
  int axis = 0;
  Type type = Type::float32;  // the type in the output
};

constexpr std::int64_t largest_of(Type type) {
  constexpr std::array<std::int64_t, 6> largest{127, 255, 32767, 65535, 2147483647, 4294967295};
  return largest[static_cast<std::size_t>(type)];
}

class Patcher {
 public:
  explicit Patcher(const PatchRequest& request)
      : request_(request),
        layout_(read_layout(request.source)),
        swapped_(is_swapped(layout_.header.encoding)),
        treatments_(layout_.vertices().properties.size()) {
    for (std::size_t i = 0; i < treatments_.size(); ++i)
      treatments_[i].type = layout_.vertices().properties[i].type;
    const Extension* extension = request.extension;
    const bool any_written = request.any_moved || (extension != nullptr && extension->X.rows() > 0);
    if (any_written || request.types == CoordinateTypes::float32 ||
        request.types == CoordinateTypes::float64) {
      plan_positions();
    }
    if (request.any_moved && layout_.normal[0] >= 0) plan_normals();
    if (extension == nullptr) return;
    plan_indices();
    new_vertices_.emplace(request, layout_);
    new_faces_.emplace(request, layout_);
  }

  std::vector<std::string> run(ByteSink& out) {
    BytePatcher file(request_.source, out);
    patch_header(file);
    with_body(request_.source, layout_.header,
              [&](auto body) { patch_body(std::move(body), file, out); });
    file.finish();
    return std::move(notes_);
  }

 private:
  const Property& property(int i) const { return layout_.vertices().properties[i]; }

  void plan_positions() {
    CoordinateTypes types = request_.types;
    std::string why = request_.why_float64;
    if (types == CoordinateTypes::by_rounding || types == CoordinateTypes::float32) {
      std::string cost = cost_of_float32();
      if (types == CoordinateTypes::float32) {
        require_range();
        if (!cost.empty()) notes_.push_back(std::move(cost));
      } else {
        types = cost.empty() ? CoordinateTypes::as_declared : CoordinateTypes::float64;
        why = std::move(cost);
      }
    }
    bool to_float = false, to_double = false;
    for (int c = 0; c < 3; ++c) {
      const int i = layout_.position[c];
      const Type type = type_of_position(property(i).type, types);
      const bool changed = type != property(i).type;
      to_float = to_float || (changed && type == Type::float32);
      to_double = to_double || (changed && type == Type::float64);
      treatments_[i] = {Treatment::Kind::position, c, type};
    }
    if (to_float) {
      notes_.emplace_back("the coordinates are declared float now, and are rounded to float32");
    }
    if (to_double) note_double(why);
  }

  /// The reason why float32 does not suffice; empty if it does.
  std::string cost_of_float32() const {
    RoundingSums sums(request_.mesh, request_.X, static_cast<Index>(request_.X.rows()));
    if (request_.extension != nullptr) sums.add(request_.extension->X);
    return float32_suffices(sums) ? std::string() : why_float32_fails(sums);
  }

  /// An integer cannot hold a moved coordinate, so that only real types are kept.
  static Type type_of_position(Type declared, CoordinateTypes types) {
    if (types == CoordinateTypes::float32) return Type::float32;
    return types == CoordinateTypes::as_declared && is_real(declared) ? declared : Type::float64;
  }

  void require_range() const {
    constexpr std::string_view holder = "a PLY file with float coordinates";
    require_float32_range(request_.X, holder);
    if (request_.extension == nullptr) return;
    const auto first = static_cast<Index>(request_.X.rows());
    require_float32_range(request_.extension->X, holder, [&](Index v) { return first + v; });
  }

  void note_double(const std::string& why) {
    notes_.push_back(
        fmt::format("the coordinates are declared double now{}",
                    why.empty() ? "" : fmt::format(": {} (--precision float rounds them)", why)));
  }

  void plan_normals() {
    const auto& normal = layout_.normal;
    const bool real =
        std::all_of(normal.begin(), normal.end(), [&](int i) { return is_real(property(i).type); });
    for (int c = 0; c < 3; ++c) {
      const int i = normal[c];
      treatments_[i] = {real ? Treatment::Kind::normal : Treatment::Kind::drop, c,
                        property(i).type};
    }
    if (real) {
      normals_.emplace(request_.mesh.faces, request_.mesh.X, request_.X, request_.moved);
    } else {
      notes_.emplace_back("dropped the normals: what their integers mean is not known");
    }
  }

  /// If the type of the faces' vertex numbers cannot hold the largest new number, a wider type is
  /// used.
  void plan_indices() {
    const Property& indices = index_property();
    index_type_ = indices.type;
    const std::int64_t last = layout_.vertices().count + request_.extension->X.rows() - 1;
    if (last <= largest_of(index_type_)) return;
    index_type_ = Type::int32;
    notes_.emplace_back(
        fmt::format("the faces' vertex numbers are declared int now: {} cannot "
                    "hold {}",
                    indices.type_text, last));
  }

  const Property& index_property() const { return layout_.faces().properties[layout_.indices]; }

  void patch_header(BytePatcher& file) const {
    const std::vector<Element>& elements = layout_.header.elements;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (e == layout_.vertex) {
        if (request_.extension != nullptr) {
          replace_count(elements[e], request_.extension->X.rows(), file);
        }
        patch_vertex_properties(file);
      } else if (e == layout_.face && request_.extension != nullptr) {
        replace_count(elements[e], request_.extension->F.rows(), file);
        if (index_type_ != index_property().type) {
          replace_type(index_property(), "int", "int32", file);
        }
      }
    }
  }

  static void replace_count(const Element& element, std::int64_t more, BytePatcher& file) {
    std::string text;
    append_integer(text, element.count + more);
    const std::string_view old = element.count_text;
    if (more > 0) file.replace(old.data(), old.data() + old.size(), std::string_view(text));
  }

  /// Each type has a name with its size and one without; the new name is of the same kind as the
  /// old.
  static void replace_type(const Property& property, std::string_view name,
                           std::string_view sized_name, BytePatcher& file) {
    const std::string_view old = property.type_text;
    const bool with_size = std::isdigit(static_cast<unsigned char>(old.back())) != 0;
    file.replace(old.data(), old.data() + old.size(), with_size ? sized_name : name);
  }

  void patch_vertex_properties(BytePatcher& file) const {
    for (std::size_t i = 0; i < treatments_.size(); ++i) {
      const Property& property = layout_.vertices().properties[i];
      if (treatments_[i].kind == Treatment::Kind::drop) {
        file.remove(property.line.data(), property.line.data() + property.line.size());
      } else if (is_retyped(i)) {
        const bool single = treatments_[i].type == Type::float32;
        replace_type(property, single ? "float" : "double", single ? "float32" : "float64", file);
      }
    }
  }

  bool is_retyped(std::size_t i) const {
    return treatments_[i].kind == Treatment::Kind::position &&
           treatments_[i].type != layout_.vertices().properties[i].type;
  }

  template <class Body>
  void patch_body(Body body, BytePatcher& file, ByteSink& out) {
    const std::vector<Element>& elements = layout_.header.elements;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (e == layout_.vertex) {
        walk_rows(body, elements[e], [&](std::int64_t row, const std::vector<Span>& spans) {
          patch_row(row, spans, file);
          if (new_vertices_) new_vertices_->see(row, spans);
        });
        if (!request_.extension) return;
        if (request_.extension->X.rows() == 0) continue;
        insert_rows(body, file, out,
                    [&](RowWriter& row) { new_vertices_->write(stored_types(), row); });
      } else if (e == layout_.face && request_.extension) {
        walk_rows(body, elements[e], [&](std::int64_t row, const std::vector<Span>& spans) {
          widen_indices(spans[layout_.indices], file);
          new_faces_->see(row, spans);
        });
        insert_rows(body, file, out, [&](RowWriter& row) {
          for (std::string& note : new_faces_->write(index_type_, row))
            notes_.push_back(std::move(note));
        });
      } else {
        body.skip_rows(elements[e]);
      }
    }
  }

  template <class Body, class Visit>
  static void walk_rows(Body& body, const Element& element, Visit&& visit) {
    body.start_element(element);
    std::vector<Span> spans(element.properties.size());
    for (std::int64_t row = 0; row < element.count; ++row) {
      body.start_row(row);
      for (std::size_t i = 0; i < spans.size(); ++i) {
        const char* before = body.after_value();
        spans[i].first = body.position();
        // The bytes before the first value of a row are the end of the line before.
        spans[i].before = i == 0 ? spans[i].first : before;
        body.skip(element.properties[i]);
        spans[i].last = body.after_value();
      }
      visit(row, spans);
      body.end_row();
    }
  }

  /// Calls write(row), whose output is inserted after the rows that have just been read.
  template <class Body, class Write>
  void insert_rows(Body& body, BytePatcher& file, ByteSink& out, Write&& write) const {
    const bool ascii = layout_.header.encoding == Encoding::ascii;
    std::string_view line_end = body.take_line_end();
    file.copy_up_to(body.after_value());
    if (ascii && line_end.empty()) {
      line_end = first_line_end(request_.source.view());
      out.write(line_end);
    }
    RowWriter row(out, layout_.header.encoding, line_end);
    write(row);
  }

  std::vector<std::optional<Type>> stored_types() const {
    std::vector<std::optional<Type>> types;
    for (const Treatment& treatment : treatments_) {
      types.push_back(treatment.kind == Treatment::Kind::drop ? std::nullopt
                                                              : std::optional(treatment.type));
    }
    return types;
  }

  void widen_indices(const Span& list, BytePatcher& file) const {
    const Property& indices = index_property();
    if (index_type_ == indices.type || layout_.header.encoding == Encoding::ascii) return;
    const char* first = list.first + size_of(indices.count_type);
    file.copy_up_to(first);
    for (const char* p = first; p != list.last; p += size_of(indices.type)) {
      const double index =
          number_at({p, p, p + size_of(indices.type)}, indices.type, layout_.header.encoding);
      char bytes[sizeof(Index)];
      file.replace(p, p + size_of(indices.type),
                   bytes_of(static_cast<Index>(index), swapped_, bytes));
    }
  }

  void patch_row(std::int64_t row, const std::vector<Span>& spans, BytePatcher& file) const {
    const bool binary = layout_.header.encoding != Encoding::ascii;
    const bool moved = request_.moved[row] != 0;
    const bool stale = normals_ && normals_->is_stale(row);
    const Vec3 normal = stale ? normals_->renew(row, old_normal(spans)) : Vec3::Zero();
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const auto [kind, axis, type] = treatments_[i];
      const double position = request_.X(row, axis);
      if (kind == Treatment::Kind::drop) {
        file.remove(spans[i].before, spans[i].last);
      } else if (kind == Treatment::Kind::normal && stale) {
        replace(spans[i], normal[axis], type, file);
      } else if (kind == Treatment::Kind::position &&
                 ((moved && position != request_.mesh.X(row, axis)) || (binary && is_retyped(i)))) {
        replace(spans[i], position, type, file);
      }
    }
  }

  Vec3 old_normal(const std::vector<Span>& spans) const {
    Vec3 normal;
    for (int c = 0; c < 3; ++c) {
      const int i = layout_.normal[c];
      const double value = number_at(spans[i], property(i).type, layout_.header.encoding);
      normal[c] = std::isnan(value) ? 0.0 : value;
    }
    return normal;
  }

  template <class T>
  void replace_by(const Span& span, T value, BytePatcher& file) const {
    if (layout_.header.encoding == Encoding::ascii) {
      file.replace(span.first, span.last, value);
    } else {
      char bytes[sizeof(T)];
      file.replace(span.first, span.last, bytes_of(value, swapped_, bytes));
    }
  }

  void replace(const Span& span, double value, Type type, BytePatcher& file) const {
    if (type == Type::float64) {
      replace_by(span, value, file);
    } else {
      replace_by(span, static_cast<float>(value), file);
    }
  }

  const PatchRequest& request_;
  Layout layout_;
  bool swapped_;
  std::vector<Treatment> treatments_;  // one for each vertex property
  Type index_type_ = Type::int32;      // the type of the faces' vertex numbers in the output
  std::optional<RenewedNormals> normals_;
  std::optional<VertexAppender> new_vertices_;
  std::optional<FaceAppender> new_faces_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> patch(const PatchRequest& request, ByteSink& out) {
  return Patcher(request).run(out);
}

}  // namespace ibmfair::ply
