// Writes a PLY file with only the coordinates of moved vertices, and what depends on them, changed.
#include <algorithm>
#include <cctype>
#include <optional>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_body.h"

namespace ibmfair::ply {
namespace {

/// What happens to a vertex property.
struct Treatment {
  enum class Kind : std::uint8_t { copy, position, normal, drop } kind = Kind::copy;
  int axis = 0;
  Type type = Type::float32;  // that it is stored as afterwards
};

/// Where a value stands in the file, and where the one before it ended.
struct Span {
  const char* before = nullptr;
  const char* first = nullptr;
  const char* last = nullptr;
};

class Patcher {
 public:
  explicit Patcher(const PatchRequest& request)
      : request_(request),
        layout_(read_layout(request.source)),
        swapped_(is_swapped(layout_.header.encoding)) {
    plan_positions();
    if (layout_.normal[0] >= 0) plan_normals();
  }

  std::vector<std::string> run(AtomicFile& out) {
    BytePatcher file(request_.source, out);
    patch_header(file);
    if (layout_.header.encoding == Encoding::ascii) {
      patch_vertices(AsciiBody(request_.source, layout_.header), file);
    } else {
      patch_vertices(BinaryBody(request_.source, layout_.header), file);
    }
    file.finish();
    return std::move(notes_);
  }

 private:
  const Property& property(int i) const {
    return layout_.vertices().properties[static_cast<std::size_t>(i)];
  }

  void plan_positions() {
    treatments_.resize(layout_.vertices().properties.size());
    bool rounded = false;
    bool promoted = false;
    for (int c = 0; c < 3; ++c) {
      const int i = layout_.position[static_cast<std::size_t>(c)];
      const Type declared = property(i).type;
      // An integer could hold no moved coordinate at all, so that `keep` can only mean float.
      const bool keep =
          declared == Type::float64 ||
          (declared == Type::float32 && request_.ply_real == WriteOptions::PlyReal::keep);
      rounded = rounded || (keep && declared == Type::float32);
      promoted = promoted || !keep;
      treatments_[static_cast<std::size_t>(i)] = {Treatment::Kind::position, c,
                                                  keep ? declared : Type::float64};
    }
    if (promoted)
      notes_.emplace_back("the coordinates are declared double now, to keep them exact");
    if (rounded) notes_.emplace_back("the coordinates of moved vertices are rounded to float32");
  }

  void plan_normals() {
    const auto& normal = layout_.normal;
    const bool real =
        std::all_of(normal.begin(), normal.end(), [&](int i) { return is_real(property(i).type); });
    for (int c = 0; c < 3; ++c) {
      const int i = normal[static_cast<std::size_t>(c)];
      treatments_[static_cast<std::size_t>(i)] = {
          real ? Treatment::Kind::normal : Treatment::Kind::drop, c, property(i).type};
    }
    if (real) {
      normals_.emplace(request_.mesh.faces, request_.mesh.X, request_.X, request_.moved);
    } else {
      notes_.emplace_back("dropped the normals: what their integers mean is not known");
    }
  }

  void patch_header(BytePatcher& file) const {
    for (std::size_t i = 0; i < treatments_.size(); ++i) {
      const Property& property = layout_.vertices().properties[i];
      const std::string_view type = property.type_text;
      if (treatments_[i].kind == Treatment::Kind::drop) {
        file.remove(property.line.data(), property.line.data() + property.line.size());
      } else if (is_promoted(i)) {
        const bool with_size = std::isdigit(static_cast<unsigned char>(type.back())) != 0;
        file.replace(type.data(), type.data() + type.size(),
                     std::string_view(with_size ? "float64" : "double"));
      }
    }
  }

  bool is_promoted(std::size_t i) const {
    return treatments_[i].kind == Treatment::Kind::position &&
           treatments_[i].type != layout_.vertices().properties[i].type;
  }

  template <class Body>
  void patch_vertices(Body body, BytePatcher& file) const {
    const std::vector<Element>& elements = layout_.header.elements;
    for (std::size_t e = 0; e < layout_.vertex; ++e)
      body.skip_rows(elements[e]);
    const Element& vertex = layout_.vertices();
    body.start_element(vertex);
    std::vector<Span> spans(treatments_.size());
    for (std::int64_t row = 0; row < vertex.count; ++row) {
      body.start_row(row);
      for (std::size_t i = 0; i < spans.size(); ++i) {
        const char* before = body.after_value();
        spans[i].first = body.position();
        // What precedes a row's first value is the end of the line before.
        spans[i].before = i == 0 ? spans[i].first : before;
        body.skip(vertex.properties[i]);
        spans[i].last = body.after_value();
      }
      patch_row(row, spans, file);
      body.end_row();
    }
  }

  void patch_row(std::int64_t row, const std::vector<Span>& spans, BytePatcher& file) const {
    const bool binary = layout_.header.encoding != Encoding::ascii;
    const bool moved = request_.moved[static_cast<std::size_t>(row)] != 0;
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
                 ((moved && position != request_.mesh.X(row, axis)) ||
                  (binary && is_promoted(i)))) {
        replace(spans[i], position, type, file);
      }
    }
  }

  Vec3 old_normal(const std::vector<Span>& spans) const {
    Vec3 normal;
    for (int c = 0; c < 3; ++c) {
      const int i = layout_.normal[static_cast<std::size_t>(c)];
      const Span& span = spans[static_cast<std::size_t>(i)];
      normal[c] = 0.0;
      if (layout_.header.encoding == Encoding::ascii) {
        parse_real(span.first, span.last, normal[c]);
      } else {
        normal[c] = property(i).type == Type::float32 ? load<float>(span.first, swapped_)
                                                      : load<double>(span.first, swapped_);
      }
    }
    return normal;
  }

  template <class T>
  void replace_by(const Span& span, T value, BytePatcher& file) const {
    char text[real_text_capacity];
    file.replace(span.first, span.last,
                 layout_.header.encoding == Encoding::ascii ? real_text(value, text)
                                                            : bytes_of(value, swapped_, text));
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
  std::vector<Treatment> treatments_;  // one a vertex property
  std::optional<RenewedNormals> normals_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> patch(const PatchRequest& request, AtomicFile& out) {
  return Patcher(request).run(out);
}

}  // namespace ibmfair::ply
