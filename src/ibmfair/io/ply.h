// PLY, ascii and binary in both byte orders: the functions in its row of the format table. The mesh
// has vertex positions and faces (or triangle strips) only; the patching writer keeps every other
// element and property.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/face_edits.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/ply_header.h"

namespace ibmfair::ply {

/// The elements and properties in a header that describe the mesh.
struct Layout {
  Header header;
  std::size_t vertex = 0;                     ///< the element `vertex`
  std::size_t face = 0;                       ///< the element `face` or `tristrips`
  std::array<int, 3> position{};              ///< the properties x, y, z
  std::array<int, 3> normal{-1, -1, -1};      ///< nx, ny, nz; -1 if there are none
  std::array<int, 2> texture{-1, -1};         ///< s, t (or u, v); -1 if there are none
  std::array<int, 4> colour{-1, -1, -1, -1};  ///< red, green, blue, alpha; -1 if there is none
  int indices = -1;                           ///< the list of vertex numbers of a face
  int face_texture = -1;  ///< the list `texcoord`, two values for each corner; -1 if there is none
  bool strips = false;    ///< the faces are triangle strips, separated by -1

  const Element& vertices() const { return header.elements[vertex]; }
  const Element& faces() const { return header.elements[face]; }
};

/// Whether `property`, a property's position in its element, is one of `properties`.
inline bool contains(std::span<const int> properties, std::size_t property) {
  return std::find(properties.begin(), properties.end(), static_cast<int>(property)) !=
         properties.end();
}

/// Reads the header and finds the mesh in it. Throws BadFile if there is no mesh.
Layout read_layout(const SourceBytes& source);

/// Finds the mesh in a header that was read from `source`. Throws BadFile if there is no mesh.
Layout find_layout(const SourceBytes& source, Header header);

bool recognises(std::string_view bytes);
ParsedMesh read(const SourceBytes& source, std::string_view extension);

/// Reads the texture coordinates of face corners from the list `texcoord`, two values for each
/// corner. A face whose list has another length gets none.
void read_face_texture(const SourceBytes& source, const Layout& layout, const Mesh& mesh,
                       MeshAttributes& attributes);

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh);
/// Whether this value of the mask property selects the vertex.
inline bool selects(double value) {
  return std::isfinite(value) && value != 0;
}
std::vector<std::uint8_t> vertex_mask(const SourceBytes& source, const Mesh& mesh,
                                      std::string_view name);
std::optional<std::vector<double>> vertex_values(const SourceBytes& source, std::string_view name);
bool edit_faces(const EditRequest& request, ByteSink& out);
std::vector<std::string> patch(const PatchRequest& request, ByteSink& out);
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::ply
