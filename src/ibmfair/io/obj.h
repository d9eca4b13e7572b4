// Wavefront OBJ: the functions of its row in the format table. Positions and faces are modelled;
// every other statement is carried along by the patching writer.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/formats.h"

namespace ibmfair::obj {

/// Texture coordinates and normals, as the corners of the faces refer to them.
struct CornerReferences {
  std::vector<std::array<double, 2>> texture_coordinates;  ///< of the `vt` statements
  std::vector<std::array<double, 3>> normals;              ///< of the `vn` statements
  std::vector<Index> corner_texture;                       ///< #corners, -1 where there is none
  std::vector<Index> corner_normal;                        ///< #corners, -1 where there is none
};

bool recognises(std::string_view bytes);
ParsedMesh read(const SourceBytes& source, std::string_view extension);
CornerReferences read_corner_references(const SourceBytes& source);
/// Row number of a reference as written, `count_so_far` rows having been read; -1 where there is
/// none or it leads nowhere.
Index resolve_reference(std::int64_t raw, std::size_t count_so_far);

/// Whether a statement says what the faces behind it belong to: a group, object or material.
bool is_face_statement(std::string_view keyword);

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh);
std::vector<std::uint8_t> vertex_mask(const SourceBytes& source, const Mesh& mesh,
                                      std::string_view name);
std::vector<std::string> patch(const PatchRequest& request, ByteSink& out);

/// Writes what stands behind the source's text: the request's extension. Returns notes.
std::vector<std::string> append(const PatchRequest& request, bool with_normals, ByteSink& out);
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::obj
