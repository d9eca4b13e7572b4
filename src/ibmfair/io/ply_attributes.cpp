// Reads the contents of a PLY file besides positions and faces: texture coordinates, colours,
// properties.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_body.h"

namespace ibmfair::ply {
namespace {

template <class Body>
void skip_elements_before(const Layout& layout, std::size_t element, Body& body) {
  for (std::size_t e = 0; e < element; ++e)
    body.skip_rows(layout.header.elements[e]);
}

/// Attributes must be finite, because not every format that they are written to can hold NaN or
/// infinity.
double finite_or_zero(double value) {
  return std::isfinite(value) ? value : 0.0;
}

/// Reads scalar vertex properties: one row for each vertex, one column for each property.
std::vector<double> read_columns(const SourceBytes& source, const Layout& layout,
                                 const std::vector<int>& columns) {
  const Element& vertex = layout.vertices();
  std::vector<double> values(columns.size() * static_cast<std::size_t>(vertex.count));
  with_body(source, layout.header, [&](auto body) {
    skip_elements_before(layout, layout.vertex, body);
    read_rows(body, vertex, [&](std::int64_t row, std::size_t i) {
      const auto column = std::find(columns.begin(), columns.end(), static_cast<int>(i));
      if (column == columns.end()) return false;
      values[row * std::ssize(columns) + (column - columns.begin())] =
          body.any_real(vertex.properties[i].type);
      return true;
    });
  });
  return values;
}

void read_colours(const SourceBytes& source, const Layout& layout, MeshAttributes& attributes) {
  attributes.opacity = layout.colour[3] >= 0;
  const std::size_t channels = attributes.opacity ? 4 : 3;
  const std::vector<int> columns(layout.colour.begin(), layout.colour.begin() + channels);
  const std::vector<double> values = read_columns(source, layout, columns);
  // The largest value of a channel is 255 for integers of one byte, 65535 for larger integers, and
  // 1 for reals.
  std::array<double, 4> full{1, 1, 1, 1};
  for (std::size_t c = 0; c < channels; ++c) {
    const Type type = layout.vertices().properties[columns[c]].type;
    if (!is_real(type)) full[c] = size_of(type) == 1 ? 255.0 : 65535.0;
    if (size_of(type) == 1) attributes.byte_colours = true;
  }
  attributes.colours.assign(values.size() / channels, {0, 0, 0, 1});
  for (std::size_t v = 0; v < attributes.colours.size(); ++v) {
    for (std::size_t c = 0; c < channels; ++c) {
      attributes.colours[v][c] = finite_or_zero(values[v * channels + c]) / full[c];
    }
  }
}

void read_vertex_texture(const SourceBytes& source, const Layout& layout, const Mesh& mesh,
                         MeshAttributes& attributes) {
  const std::vector<double> values =
      read_columns(source, layout, {layout.texture[0], layout.texture[1]});
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    attributes.texture_coordinates.push_back(
        {finite_or_zero(values[i]), finite_or_zero(values[i + 1])});
  }
  attributes.corner_texture = mesh.faces.corner;
}

void list_uncarried(const Layout& layout, MeshAttributes& attributes) {
  const std::vector<Element>& elements = layout.header.elements;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (e != layout.vertex && e != layout.face) {
      attributes.uncarried.push_back(fmt::format("element '{}'", elements[e].name));
      continue;
    }
    for (std::size_t i = 0; i < elements[e].properties.size(); ++i) {
      const bool known =
          e == layout.vertex
              ? contains(layout.position, i) || contains(layout.normal, i) ||
                    contains(layout.texture, i) || contains(layout.colour, i)
              : static_cast<int>(i) == layout.indices || static_cast<int>(i) == layout.face_texture;
      if (known) continue;
      attributes.uncarried.push_back(
          fmt::format("{} property '{}'", elements[e].name, elements[e].properties[i].name));
    }
  }
  if (!layout.header.comments.empty()) attributes.uncarried.emplace_back("comments");
}

}  // namespace

void read_face_texture(const SourceBytes& source, const Layout& layout, const Mesh& mesh,
                       MeshAttributes& attributes) {
  const Property& list = layout.faces().properties[layout.face_texture];
  attributes.corner_texture.assign(mesh.faces.corner.size(), -1);
  with_body(source, layout.header, [&](auto body) {
    skip_elements_before(layout, layout.face, body);
    read_rows(body, layout.faces(), [&](std::int64_t f, std::size_t i) {
      if (static_cast<int>(i) != layout.face_texture) return false;
      std::vector<double> values(body.count(list));
      for (double& value : values)
        value = finite_or_zero(body.any_real(list.type));
      const std::int64_t first = mesh.faces.first[f], corners = mesh.faces.first[f + 1] - first;
      if (std::ssize(values) != 2 * corners) return true;
      for (std::int64_t c = 0; c < corners; ++c) {
        attributes.corner_texture[first + c] =
            static_cast<Index>(attributes.texture_coordinates.size());
        attributes.texture_coordinates.push_back({values[2 * c], values[2 * c + 1]});
      }
      return true;
    });
  });
}

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh) {
  const Layout layout = read_layout(source);
  MeshAttributes attributes;
  attributes.normals = layout.normal[0] >= 0;
  if (layout.colour[0] >= 0) read_colours(source, layout, attributes);
  if (layout.face_texture >= 0) {
    read_face_texture(source, layout, mesh, attributes);
  } else if (layout.texture[0] >= 0) {
    read_vertex_texture(source, layout, mesh, attributes);
  }
  list_uncarried(layout, attributes);
  return attributes;
}

std::optional<std::vector<double>> vertex_values(const SourceBytes& source, std::string_view name) {
  const Layout layout = read_layout(source);
  const Element& vertex = layout.vertices();
  const int column = vertex.find(source, name);
  if (column < 0 || vertex.properties[column].is_list) {
    return std::nullopt;
  }
  return read_columns(source, layout, {column});
}

std::vector<std::uint8_t> vertex_mask(const SourceBytes& source, const Mesh& /*mesh*/,
                                      std::string_view name) {
  const auto values = vertex_values(source, name);
  if (!values) {
    const Layout layout = read_layout(source);
    std::vector<std::string> names;
    for (const Property& property : layout.vertices().properties) {
      if (!property.is_list) names.push_back(property.name);
    }
    throw BadOption(fmt::format("{}: no vertex property is called '{}'; there are: {}",
                                source.name(), name, fmt::join(names, ", ")));
  }
  std::vector<std::uint8_t> mask;
  mask.reserve(values->size());
  for (const double value : *values) {
    mask.push_back(selects(value));
  }
  return mask;
}

}  // namespace ibmfair::ply
