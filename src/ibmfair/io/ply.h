// PLY, ascii and binary of both byte orders: the functions of its row in the format table. Vertex
// positions and faces (or triangle strips) are modelled; every other element and property is
// carried along by the patching writer.
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

#include "ibmfair/io/formats.h"
#include "ibmfair/io/ply_header.h"

namespace ibmfair::ply {

/// The parts of a header that make a mesh.
struct Layout {
  Header header;
  std::size_t vertex = 0;                     ///< the element `vertex`
  std::size_t face = 0;                       ///< the element `face` or `tristrips`
  std::array<int, 3> position{};              ///< the properties x, y, z
  std::array<int, 3> normal{-1, -1, -1};      ///< nx, ny, nz; -1 where there are none
  std::array<int, 2> texture{-1, -1};         ///< s, t (or u, v); -1 where there are none
  std::array<int, 4> colour{-1, -1, -1, -1};  ///< red, green, blue, alpha; -1 where there is none
  int indices = -1;                           ///< the list of a face's vertices
  int face_texture = -1;                      ///< the list `texcoord`, two values a corner
  bool strips = false;                        ///< triangle strips with -1 between them

  const Element& vertices() const { return header.elements[vertex]; }
  const Element& faces() const { return header.elements[face]; }
};

/// Whether a property (its place in its element) is one of those named.
inline bool contains(std::span<const int> properties, std::size_t property) {
  return std::find(properties.begin(), properties.end(), static_cast<int>(property)) !=
         properties.end();
}

/// Reads the header and finds the mesh in it. Throws BadFile where there is none.
Layout read_layout(const SourceBytes& source);

/// Finds the mesh in a header that has been read from `source`. Throws BadFile where there is none.
Layout find_layout(const SourceBytes& source, Header header);

bool recognises(std::string_view bytes);
ParsedMesh read(const SourceBytes& source, std::string_view extension);

/// The texture coordinates of the faces' list `texcoord`, two values a corner; a list of another
/// length leaves its face without.
void read_face_texture(const SourceBytes& source, const Layout& layout, const Mesh& mesh,
                       MeshAttributes& attributes);

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh);
/// Whether a vertex is selected by this value of the property that is the mask.
inline bool selects(double value) {
  return std::isfinite(value) && value != 0;
}
std::vector<std::uint8_t> vertex_mask(const SourceBytes& source, const Mesh& mesh,
                                      std::string_view name);
std::optional<std::vector<double>> vertex_values(const SourceBytes& source, std::string_view name);
std::vector<std::string> patch(const PatchRequest& request, ByteSink& out);
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::ply
