// What the corners of an extension's faces get, and the attributes of a mesh with its extension.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// The corners of the source, as rows of Polygons::corner, whose texture coordinates and normals
/// are used at vertices of the source; -1 where there is none.
struct SourceCorners {
  std::vector<std::int64_t> of_rim;   ///< #rim
  std::vector<std::int64_t> of_face;  ///< 3 a new face; -1 at new vertices
};
SourceCorners find_source_corners(const Mesh& mesh, const Extension& extension);

/// Rows of texture coordinates or normals that corners refer to.
struct NewRows {
  std::vector<Index> vertex;  ///< the new vertices that have one, in the order of the rows
  std::vector<Index> corner;  ///< 3 a new face, rows; all -1 where one of the three has none
};

/// Numbers the rows of `values` (a row per new vertex) that are known, from `count` on, the number
/// of rows of the source. `corner` (3 a new face) has the rows that corners at vertices of the
/// source use, -1 elsewhere.
NewRows number_new_rows(const Extension& extension, Index source_vertices,
                        const Eigen::MatrixXd& values, std::vector<Index> corner, Index count);

/// Appends texture coordinates, and the rows to which the corners of the new faces refer.
void extend_corner_texture(MeshAttributes& attributes, const Mesh& mesh,
                           const Extension& extension);

/// OBJ statements that give each new face the state of its model face, as
/// MeshAttributes::face_statements; faces are numbered on from `source_faces`. Appends to `notes`.
std::vector<std::pair<Index, std::string>> statements_before_new_faces(
    const std::vector<std::pair<Index, std::string>>& of_source, const Extension& extension,
    Index source_faces, std::vector<std::string>& notes);

/// The attributes of extended_mesh. Appends to `notes` what could not be kept.
MeshAttributes extended_attributes(MeshAttributes attributes, const Mesh& mesh,
                                   const Extension& extension, std::vector<std::string>& notes);

}  // namespace ibmfair
