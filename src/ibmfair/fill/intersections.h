// Finds intersections of patches with each other, with themselves and with the mesh.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The pairs of triangles of `F` that intersect outside of shared corners, sorted. The second
/// triangle of each pair belongs to a patch: its number is at least `patch_from`. Triangles that
/// share an edge are not compared, because their overlap is a foldover (flow/steps/folds.h). Exact,
/// by CGAL's predicates.
std::vector<std::array<Index, 2>> patch_intersections(const Points& X, const Triangles& F,
                                                      Index patch_from);

}  // namespace ibmfair
