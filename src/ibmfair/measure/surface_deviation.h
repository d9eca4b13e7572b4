// How far a mesh is from a surface that is known exactly.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/measure/normal_angles.h"
#include "ibmfair/measure/statistics.h"

namespace ibmfair {

struct SurfaceDeviation {
  Statistics distance;  ///< of the vertices that belong to a triangle, length; `where` is a vertex
  NormalAngles angles;  ///< of the triangles, to the surface's normal at the point closest to their
                        ///< centroid; `flipped` ones face against the surface
};

/// X is #V x 3, F #F x 3 with the orientation that is to be judged.
SurfaceDeviation deviation_from(const ExactSurface& surface, const Points& X, const Triangles& F);

}  // namespace ibmfair
