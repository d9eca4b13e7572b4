// Where patches pass through each other or through the mesh.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Pairs of triangles of `F` that meet elsewhere than in the corners they share, the second one
/// always a triangle of a patch: from `patch_from` on. Neighbours across an edge are not compared;
/// those folded over each other are folds. Exact, by CGAL's predicates. Sorted.
std::vector<std::array<Index, 2>> patch_intersections(const Points& X, const Triangles& F,
                                                      Index patch_from);

}  // namespace ibmfair
