#include "petsc_engine/ply_rows.h"

#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/ply_body.h"

namespace ibmfair::petsc {
namespace {

/// The offset (bytes) of a property in a row, if all properties before it are scalars.
std::int64_t offset_of(const ply::Element& element, int property) {
  std::int64_t offset = 0;
  for (int i = 0; i < property; ++i) {
    offset += size_of(element.properties[i].type);
  }
  return offset;
}

/// Whether the face element has exactly one list property, the list of vertices.
bool has_only_list(const ply::Layout& layout) {
  const auto& properties = layout.faces().properties;
  return std::count_if(properties.begin(), properties.end(),
                       [](const ply::Property& p) { return p.is_list; }) == 1;
}

/// The header with the count of each element replaced.
template <class CountOf>
std::string with_counts(std::string_view text, const ply::Header& header, const CountOf& count_of) {
  std::string result;
  const char* copied = text.data();
  for (const ply::Element& element : header.elements) {
    result.append(copied, element.count_text.data());
    result += fmt::format("{}", count_of(element));
    copied = element.count_text.data() + element.count_text.size();
  }
  return result.append(copied, text.data() + text.size());
}

}  // namespace

std::optional<PlyRows> PlyRows::find(const std::string& name, std::string_view start,
                                     std::int64_t file_size) {
  PlyRows rows;
  try {
    const auto bytes = SourceBytes::from_memory(name, start);
    const ply::Header header = ply::read_lone_header(*bytes);
    const auto size = static_cast<std::size_t>(header.body - bytes->begin());
    rows.header_ = SourceBytes::from_memory(name, start.substr(0, size));
    rows.layout_ = ply::find_layout(*rows.header_, ply::read_lone_header(*rows.header_));
  } catch (const Error&) {
    return std::nullopt;  // the reader of whole files will report the error
  }
  const ply::Layout& layout = rows.layout_;
  if (layout.header.encoding == ply::Encoding::ascii || layout.strips || !has_only_list(layout) ||
      layout.vertex > layout.face || layout.vertices().count > most_elements ||
      layout.faces().count > most_elements) {
    return std::nullopt;
  }
  auto offset = static_cast<std::int64_t>(rows.header_->size());
  for (std::size_t e = 0; e <= layout.face; ++e) {
    const ply::Element& element = layout.header.elements[e];
    std::int64_t row = element.smallest_row();
    if (e == layout.face) {
      rows.triangle_offset_ = offset;
      row += 3 * size_of(element.properties[layout.indices].type);
      rows.triangle_row_ = row;
    } else if (element.has_lists()) {
      return std::nullopt;
    }
    if (e == layout.vertex) {
      rows.vertex_offset_ = offset;
    }
    offset += row * element.count;
  }
  return offset <= file_size ? std::optional(std::move(rows)) : std::nullopt;
}

std::optional<std::vector<std::array<double, 3>>> PlyRows::positions(std::string_view rows) const {
  const ply::Element& vertex = layout_.vertices();
  const bool swapped = ply::is_swapped(layout_.header.encoding);
  std::vector<std::array<double, 3>> X(rows.size() / vertex_row());
  bool finite = true;
  for (int c = 0; c < 3; ++c) {
    const std::int64_t offset = offset_of(vertex, layout_.position[c]);
    const ply::Type type = vertex.properties[layout_.position[c]].type;
    for (std::size_t v = 0; v < X.size(); ++v) {
      X[v][c] = ply::binary_number(rows.data() + v * vertex_row() + offset, type, swapped);
      finite = finite && std::isfinite(X[v][c]);
    }
  }
  return finite ? std::optional(std::move(X)) : std::nullopt;
}

std::optional<std::vector<std::array<Index, 3>>> PlyRows::corners(std::string_view rows) const {
  const ply::Element& face = layout_.faces();
  const ply::Property& list = face.properties[layout_.indices];
  const bool swapped = ply::is_swapped(layout_.header.encoding);
  const std::int64_t offset = offset_of(face, layout_.indices);
  std::vector<std::array<Index, 3>> F(rows.size() / triangle_row());
  for (std::size_t t = 0; t < F.size(); ++t) {
    const char* p = rows.data() + t * triangle_row() + offset;
    if (ply::binary_number(p, list.count_type, swapped) != 3) {
      return std::nullopt;
    }
    p += size_of(list.count_type);
    for (int i = 0; i < 3; ++i, p += size_of(list.type)) {
      const double corner = ply::binary_number(p, list.type, swapped);
      if (!(corner >= 0 && corner < static_cast<double>(vertices()))) {
        return std::nullopt;
      }
      F[t][i] = static_cast<Index>(corner);
    }
  }
  return F;
}

std::optional<std::vector<double>> PlyRows::values(std::string_view rows,
                                                   std::string_view name) const {
  const ply::Element& vertex = layout_.vertices();
  const int property = vertex.find(*header_, name);
  if (property < 0) {
    return std::nullopt;
  }
  const std::int64_t offset = offset_of(vertex, property);
  std::vector<double> values(rows.size() / vertex_row());
  for (std::size_t v = 0; v < values.size(); ++v) {
    values[v] = ply::binary_number(rows.data() + v * vertex_row() + offset,
                                   vertex.properties[property].type,
                                   ply::is_swapped(layout_.header.encoding));
  }
  return values;
}

std::vector<std::string> PlyRows::property_names() const {
  std::vector<std::string> names;
  for (const ply::Property& property : layout_.vertices().properties) {
    names.push_back(property.name);
  }
  return names;
}

/// A PLY file with these vertices and one face without corners, because a mesh needs a face.
std::shared_ptr<const SourceBytes> PlyRows::lone_vertices(std::string_view rows,
                                                          std::int64_t count) const {
  const std::string header =
      with_counts(header_->view(), layout_.header, [&](const ply::Element& element) {
        return &element == &layout_.vertices() ? count : &element == &layout_.faces() ? 1 : 0;
      });
  return SourceBytes::from_memory(
      header_->name(), fmt::format("{}{}{}", header, rows, std::string(no_corners(), '\0')));
}

/// The number of bytes of a face without corners.
std::size_t PlyRows::no_corners() const {
  return static_cast<std::size_t>(layout_.faces().smallest_row());
}

/// The vertex rows of a file that was made by lone_vertices() and rewritten.
std::string_view PlyRows::vertices_of(const SourceBytes& written) const {
  std::string_view rows = written.view();
  rows.remove_prefix(static_cast<std::size_t>(ply::read_header(written).body - written.begin()));
  rows.remove_suffix(no_corners());
  return rows;
}

/// Replaces the counts in `header`, which was derived from this file's header, by the counts of
/// this file.
std::string PlyRows::with_own_counts(std::string_view header) const {
  const auto bytes = SourceBytes::from_memory(header_->name(), header);
  return with_counts(
      bytes->view(), ply::read_lone_header(*bytes),
      [&](const ply::Element& element) { return layout_.header.find(element.name)->count_text; });
}

PlyRows::Rewriting PlyRows::rewriting(std::string_view row, const RowTypes& types) const {
  const auto source = lone_vertices(row, 1);
  const Points X = Points::Zero(1, 3);
  MemorySink out;
  Rewriting result;
  result.notes = ply::patch(
      {*source, {X, {}}, false, false, X, {0}, true, types.types, nullptr, types.why_float64}, out);
  const auto written = SourceBytes::from_memory(header_->name(), out.text());
  const std::string_view vertex = vertices_of(*written);
  result.row = static_cast<std::int64_t>(vertex.size());
  result.header = with_own_counts(
      {written->begin(), static_cast<std::size_t>(vertex.data() - written->begin())});
  return result;
}

std::string PlyRows::rewritten(std::string_view rows, const MeshPiece& piece, const Points& X,
                               const RowTypes& types) const {
  if (piece.own == 0) {
    return {};
  }
  std::vector<std::uint8_t> moved(static_cast<std::size_t>(X.rows()));
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    moved[v] = X.row(v) != piece.X.row(v) ? 1 : 0;
  }
  const auto source = lone_vertices(rows, piece.own);
  MemorySink out;
  ply::patch(
      {*source, mesh_from_triangles(piece.X, piece.F), false, false, X, moved, true, types.types},
      out);
  const auto written = SourceBytes::from_memory(header_->name(), out.text());
  return std::string(vertices_of(*written));
}

}  // namespace ibmfair::petsc
