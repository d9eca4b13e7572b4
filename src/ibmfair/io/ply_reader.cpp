// Reads the positions and faces of a PLY file.
#include <algorithm>
#include <limits>

#include "ibmfair/io/make_room.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_body.h"

namespace ibmfair::ply {
namespace {

constexpr std::size_t largest_index = std::numeric_limits<Index>::max();

int find_scalar(const SourceBytes& source, const Element& element, std::string_view name) {
  const int found = element.find(source, name);
  if (found < 0) return -1;
  const Property& property = element.properties[found];
  return property.is_list ? -1 : found;
}

/// The positions of the properties with these names, or -1 for each if not all of them exist.
template <std::size_t n>
std::array<int, n> find_all(const SourceBytes& source, const Element& element,
                            const std::array<std::string_view, n>& names) {
  std::array<int, n> found{};
  for (std::size_t i = 0; i < n; ++i)
    found[i] = find_scalar(source, element, names[i]);
  if (std::count(found.begin(), found.end(), -1) > 0) found.fill(-1);
  return found;
}

void find_in_vertices(const SourceBytes& source, Layout& layout) {
  const Element& vertex = layout.vertices();
  layout.position = find_all<3>(source, vertex, {"x", "y", "z"});
  if (layout.position[0] < 0) {
    fail_in_text(source, vertex.count_text.data(),
                 "the vertices have no scalar properties x, y and z;");
  }
  layout.normal = find_all<3>(source, vertex, {"nx", "ny", "nz"});
  using Names = std::array<std::string_view, 2>;
  for (const Names& names : {Names{"s", "t"}, Names{"u", "v"}, Names{"texture_u", "texture_v"}}) {
    if (layout.texture[0] < 0) layout.texture = find_all<2>(source, vertex, names);
  }
  using Channels = std::array<std::string_view, 3>;
  for (const Channels& names : {Channels{"red", "green", "blue"},
                                Channels{"diffuse_red", "diffuse_green", "diffuse_blue"}}) {
    if (layout.colour[0] >= 0) continue;
    const std::array<int, 3> rgb = find_all<3>(source, vertex, names);
    layout.colour = {rgb[0], rgb[1], rgb[2], find_scalar(source, vertex, "alpha")};
  }
}

/// Finds the list of vertex numbers of an element; false if there is none.
bool find_indices(const SourceBytes& source, const Element& element, Layout& layout) {
  for (const std::string_view name : {"vertex_indices", "vertex_index"}) {
    const int found = element.find(source, name);
    if (found < 0) continue;
    const Property& property = element.properties[found];
    if (!property.is_list || is_real(property.type)) {
      fail_in_text(source, property.line.data(), "vertex numbers must be a list of integers;");
    }
    layout.indices = found;
    return true;
  }
  return false;
}

void find_in_faces(const SourceBytes& source, Layout& layout) {
  const std::vector<Element>& elements = layout.header.elements;
  for (const std::string_view name : {"face", "tristrips"}) {
    const Element* element = layout.header.find(name);
    if (element == nullptr || element->count == 0) continue;
    if (!find_indices(source, *element, layout)) continue;
    layout.face = static_cast<std::size_t>(element - elements.data());
    layout.strips = name == "tristrips";
    if (!layout.strips) layout.face_texture = element->find(source, "texcoord");
    return;
  }
  fail_in_file(source, "the mesh has no faces");
}

template <class Body>
void read_vertices(const Layout& layout, Body& body, Points& X) {
  const Element& vertex = layout.vertices();
  std::vector<int> axis(vertex.properties.size(), -1);
  for (int c = 0; c < 3; ++c)
    axis[layout.position[c]] = c;
  read_rows(body, vertex, [&](std::int64_t row, std::size_t i) {
    if (axis[i] >= 0) X(row, axis[i]) = body.real(vertex.properties[i].type);
    return axis[i] >= 0;
  });
}

template <class Body>
void read_faces(const Layout& layout, Body& body, Polygons& faces) {
  const std::int64_t vertex_count = layout.vertices().count;
  const Property& indices = layout.faces().properties[layout.indices];
  read_rows(body, layout.faces(), [&](std::int64_t /*row*/, std::size_t i) {
    if (static_cast<int>(i) != layout.indices) return false;
    const std::int64_t count = body.count(indices);
    if (count < 3) body.fail("a face needs at least three corners");
    if (faces.corner.size() + static_cast<std::size_t>(count) > largest_index) {
      body.fail("too many face corners");
    }
    body.indices(indices.type, count, 0, vertex_count, faces.corner);
    faces.first.push_back(static_cast<std::int64_t>(faces.corner.size()));
    return true;
  });
}

/// Cuts a strip into triangles and reverses every other one, as strips require. Triangles with a
/// repeated vertex only serve to join parts of the strip and are left out.
void add_strip(std::span<const Index> strip, Polygons& faces) {
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const Index a = strip[i - 2];
    const Index b = strip[i - 1];
    const Index c = strip[i];
    if (a == b || b == c || c == a) continue;
    const std::array<Index, 3> triangle =
        i % 2 == 0 ? std::array<Index, 3>{a, b, c} : std::array<Index, 3>{b, a, c};
    faces.add(triangle);
  }
}

template <class Body>
void read_strips(const Layout& layout, Body& body, Polygons& faces) {
  const Property& list = layout.faces().properties[layout.indices];
  std::vector<Index> indices;
  read_rows(body, layout.faces(), [&](std::int64_t /*row*/, std::size_t i) {
    if (static_cast<int>(i) != layout.indices) return false;
    indices.clear();
    body.indices(list.type, body.count(list), -1, layout.vertices().count, indices);
    for (auto start = indices.begin(); start != indices.end();) {
      const auto stop = std::find(start, indices.end(), -1);
      add_strip({start, stop}, faces);
      start = stop == indices.end() ? stop : stop + 1;
    }
    if (faces.corner.size() > largest_index) body.fail("too many face corners");
    return true;
  });
}

template <class Body>
void read_body(const Layout& layout, Body body, Mesh& mesh) {
  const std::vector<Element>& elements = layout.header.elements;
  const std::int64_t faces = layout.strips ? 0 : layout.faces().count;
  make_room(mesh, layout.vertices().count, faces, 3 * faces);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i == layout.vertex) {
      read_vertices(layout, body, mesh.X);
    } else if (i != layout.face) {
      body.skip_rows(elements[i]);
    } else if (layout.strips) {
      read_strips(layout, body, mesh.faces);
    } else {
      read_faces(layout, body, mesh.faces);
    }
  }
}

}  // namespace

Layout read_layout(const SourceBytes& source) {
  return find_layout(source, read_header(source));
}

Layout find_layout(const SourceBytes& source, Header header) {
  Layout layout;
  layout.header = std::move(header);
  const Element* vertex = layout.header.find("vertex");
  if (vertex == nullptr || vertex->count == 0) fail_in_file(source, "the mesh has no vertices");
  layout.vertex = static_cast<std::size_t>(vertex - layout.header.elements.data());
  find_in_vertices(source, layout);
  find_in_faces(source, layout);
  return layout;
}

bool recognises(std::string_view bytes) {
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r") || bytes.starts_with("ply ");
}

ParsedMesh read(const SourceBytes& source, std::string_view /*extension*/) {
  const Layout layout = read_layout(source);
  ParsedMesh parsed;
  with_body(source, layout.header,
            [&](auto body) { read_body(layout, std::move(body), parsed.mesh); });
  parsed.has_normals = layout.normal[0] >= 0;
  parsed.has_texture_coordinates = layout.texture[0] >= 0 || layout.face_texture >= 0;
  return parsed;
}

}  // namespace ibmfair::ply
