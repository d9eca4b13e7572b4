// The attributes of a mesh with an extension, including those of the new faces' corners.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Corners of the source (rows of Polygons::corner) whose texture coordinates and normals are used
/// at vertices of the source; -1 if there is none.
struct SourceCorners {
  std::vector<std::int64_t> of_rim;   ///< #rim, one for each vertex of the rim
  std::vector<std::int64_t> of_face;  ///< 3 for each new face; -1 at new vertices
};
SourceCorners find_source_corners(const Mesh& mesh, const Extension& extension);

/// New rows of texture coordinates or normals, and the references of corners to rows.
struct NewRows {
  std::vector<Index> vertex;  ///< the new vertices that have a row, in the order of the rows
  /// 3 for each new face, the row of each corner; -1 for all three if one of them has no row.
  std::vector<Index> corner;
};

/// Numbers the rows of `values` (one for each new vertex) that are finite, starting with `count`,
/// the number of rows of the source. `corner` (3 for each new face) holds the rows that corners at
/// vertices of the source use, -1 elsewhere.
NewRows number_new_rows(const Extension& extension, Index source_vertices,
                        const Eigen::MatrixXd& values, std::vector<Index> corner, Index count);

/// Appends texture coordinates for the new vertices, and the rows that the corners of the new faces
/// use.
void extend_corner_texture(MeshAttributes& attributes, const Mesh& mesh,
                           const Extension& extension);

/// The OBJ statements that give each new face the group, object, material and smoothing group of
/// its model face, as in MeshAttributes::face_statements. New faces are numbered from
/// `source_faces` on. Appends to `notes`.
std::vector<std::pair<Index, std::string>> statements_before_new_faces(
    const std::vector<std::pair<Index, std::string>>& of_source, const Extension& extension,
    Index source_faces, std::vector<std::string>& notes);

/// The attributes of extended_mesh(). Appends to `notes` a sentence for everything that could not
/// be kept.
MeshAttributes extended_attributes(MeshAttributes attributes, const Mesh& mesh,
                                   const Extension& extension, std::vector<std::string>& notes);

}  // namespace ibmfair
