// The triangles and vertices of a mesh that a page shows.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

struct ShownTriangles {
  Triangles F;        ///< numbers are rows of `vertex`
  Index of_mesh = 0;  ///< number of triangles that do not belong to patches; these come first
  std::vector<Index> patch;   ///< for each of the other triangles, the patch that it belongs to
  std::vector<Index> vertex;  ///< the vertices of F as numbered in the mesh, increasing
  bool decimated = false;
};

/// Chooses the shown triangles from F (#F x 3) with vertices X. The last `patch.size()` triangles
/// belong to the patches with the numbers `patch`. If there are more than `most` triangles, they
/// are decimated; patches are decimated only if they have more than half of `most` triangles.
ShownTriangles choose_triangles(const Points& X, const Triangles& F,
                                const std::vector<Index>& patch, Index most);

}  // namespace ibmfair
