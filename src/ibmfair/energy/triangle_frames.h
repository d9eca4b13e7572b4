// What every energy needs of each triangle, computed once per evaluation.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

struct TriangleFrame {
  Vec3 normal;  ///< unit; NaN where the triangle has no area
  double area;  ///< length^2
};

/// Fills one frame per row of F (#F x 3).
void update_frames(const Points& X, const Triangles& F, std::vector<TriangleFrame>& frames);

}  // namespace ibmfair
