// Writing a mesh with vertices and faces that its file does not have, as hole filling makes them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair {

/// What is put behind a mesh's own vertices and faces.
struct Extension {
  Points X;     ///< #new vertices x 3; row k is vertex #V + k, #V being those of the source
  Triangles F;  ///< #new faces x 3; a corner below #V is a vertex of the source

  /// #new faces, a face of the source (Mesh::faces; Triangulation::face leads there) for each,
  /// whose group, material, smoothing group, colour and other properties it takes.
  std::vector<Index> model_face;

  /// Vertices of the source, each once, from which `extend` takes values.
  std::vector<Index> rim;

  /// Extends functions over the rim (#rim x columns, finite) smoothly to the new vertices (#new
  /// vertices x columns). Must be linear, treat every column alike and map constants to
  /// themselves, as harmonic extension does; one row not finite says that a vertex is not reached.
  /// Called only where there are new vertices, a rim and something to extend.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& at_rim)> extend;
};

/// Writes `source` with its vertices at `X` (#V x 3) and the extension behind them. As with the
/// write_mesh that has no extension, a file of the source's own format is the source's bytes, with
/// only the coordinates of moved vertices replaced; what is new stands behind the vertices and
/// behind the faces that it has (in OBJ, behind everything), in the order given, and counts are
/// raised. Another format is generated.
///
/// Vertex colours, texture coordinates and other real properties are extended by `extend` and then
/// held between the smallest and the largest value at the rim. Values that only some of the rim's
/// vertices have are extended from those. Integers that are no colours may be labels, which must
/// not be mixed: they are copied from the nearest vertex of the source, counted in edges of new
/// faces. A new corner at a vertex of the source has the texture coordinate and the normal that the
/// model face has there or, if it does not touch the vertex, the first face that does. Normals of
/// new vertices are those of the new faces, on the side on which the rim's normals are:
/// interpolated, they would vanish in the middle of a hemisphere.
///
/// Also throws BadMesh for an extension that does not fit the source (numbers out of range, sizes
/// that differ, a result of `extend` of the wrong shape), and whatever `extend` throws; nothing is
/// written then.
WriteReport write_mesh(const MeshFile& source, const Points& X, const Extension& extension,
                       const std::string& path, const WriteOptions& options = {});

}  // namespace ibmfair
