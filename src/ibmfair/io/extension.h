// Writes a mesh with additional vertices and faces, such as those made by hole filling.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair {

/// The vertices and faces to add after those of a mesh.
struct Extension {
  /// #new vertices x 3; row k is vertex #V + k, where #V is the vertex count of the source.
  Points X;
  Triangles F;  ///< #new faces x 3; a corner less than #V is a vertex of the source

  /// #new faces: for each new face a face of the source (as in Mesh::faces; see
  /// Triangulation::face) whose group, material, smoothing group, colour and other properties the
  /// new face takes.
  std::vector<Index> model_face;

  /// The vertices of the source from whose values `extend` computes those of new vertices; no
  /// vertex twice.
  std::vector<Index> rim;

  /// Extends values at the rim (#rim x columns, finite) smoothly to the new vertices (#new vertices
  /// x columns). Must be linear, treat every column alike and map constants to themselves, as
  /// harmonic extension does. A row of the result that is not finite means that the vertex is not
  /// reached. Called only if there are new vertices, a rim and values to extend.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& at_rim)> extend;
};

/// Writes `source` with its vertices at `X` (#V x 3), followed by the extension. As in write_mesh
/// without an extension, a file in the format of the source consists of the source's bytes, with
/// only the coordinates of moved vertices replaced. New vertices follow the source's vertices and
/// new faces follow its faces (in OBJ, both follow the whole text), in the order given, and counts
/// are raised. A file in another format is generated.
///
/// Vertex colours, texture coordinates and other real properties are extended by `extend` and then
/// clamped to the range of the values at the rim. If only some vertices of the rim have a value, it
/// is extended from those vertices. Integers other than colours may be labels, which must not be
/// mixed: they are copied from the nearest vertex of the source, where distance is the number of
/// edges of new faces. A corner of a new face at a vertex of the source has the texture coordinate
/// and the normal that its model face has there, or, if the model face does not touch the vertex,
/// those of the first face that does. Normals at new vertices are computed from the new faces and
/// oriented like the normals at the rim. They are not interpolated, because interpolated normals
/// would vanish in the middle of a hemisphere.
///
/// In addition to the exceptions of write_mesh without an extension, throws BadMesh if the
/// extension does not fit the source (numbers out of range, sizes that differ, a result of `extend`
/// of the wrong shape), and whatever `extend` throws; in these cases nothing is written.
WriteReport write_mesh(const MeshFile& source, const Points& X, const Extension& extension,
                       const std::string& path, const WriteOptions& options = {});

}  // namespace ibmfair
