// Which triangles and vertices of a mesh a page shows.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

struct ShownTriangles {
  Triangles F;                ///< numbers are rows of `vertex`
  Index of_mesh = 0;          ///< triangles that are not of patches; they stand first
  std::vector<Index> patch;   ///< for each of the others, which patch it is of
  std::vector<Index> vertex;  ///< those of F, in increasing order
  bool decimated = false;
};

/// F (#F x 3) over X, of which the last `patch.size()` triangles are of these patches. Where there
/// are more than `most` they are decimated, patches only if they are more than half of `most`.
ShownTriangles choose_triangles(const Points& X, const Triangles& F,
                                const std::vector<Index>& patch, Index most);

}  // namespace ibmfair
