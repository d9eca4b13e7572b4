// Wavefront OBJ: the functions in its row of the format table. The mesh has positions and faces
// only; the patching writer keeps every other statement.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/face_edits.h"
#include "ibmfair/io/formats.h"

namespace ibmfair::obj {

/// Texture coordinates and normals, and the references of face corners to them.
struct CornerReferences {
  std::vector<std::array<double, 2>> texture_coordinates;  ///< from the `vt` statements
  std::vector<std::array<double, 3>> normals;              ///< from the `vn` statements
  std::vector<Index> corner_texture;                       ///< #corners, -1 if there is none
  std::vector<Index> corner_normal;                        ///< #corners, -1 if there is none
};

bool recognises(std::string_view bytes);
ParsedMesh read(const SourceBytes& source, std::string_view extension);
CornerReferences read_corner_references(const SourceBytes& source);
/// The row number, from 0, of a reference as written in the file, after `count_so_far` rows have
/// been read; -1 if there is no reference or no such row.
Index resolve_reference(std::int64_t raw, std::size_t count_so_far);

/// Replaces references to rows that the file does not have, because it has only `count`, by -1.
void drop_dangling(std::vector<Index>& references, std::int64_t count);

/// Whether a statement sets the group, object, material (also its library) or smoothing group of
/// the faces that follow.
bool is_face_statement(std::string_view keyword);

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh);
std::vector<std::uint8_t> vertex_mask(const SourceBytes& source, const Mesh& mesh,
                                      std::string_view name);
bool edit_faces(const EditRequest& request, ByteSink& out);
std::vector<std::string> patch(const PatchRequest& request, ByteSink& out);

/// Writes the request's extension, which follows the text of the source. Returns notes.
std::vector<std::string> append(const PatchRequest& request, bool with_normals, ByteSink& out);
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::obj
