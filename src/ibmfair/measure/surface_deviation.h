// The deviation of a mesh from a surface that is known exactly.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/measure/normal_angles.h"
#include "ibmfair/measure/statistics.h"

namespace ibmfair {

struct SurfaceDeviation {
  Statistics distance;  ///< distances of the vertices that belong to a triangle, length; `where` is
                        ///< a vertex
  /// Between the triangles' normals and the surface's normals at the points closest to their
  /// centroids; `flipped` triangles face against the surface.
  NormalAngles angles;
};

/// The deviation of the mesh with vertices X (#V x 3) and triangles F (#F x 3) from `surface`. The
/// orientation of F determines the triangles' normals.
SurfaceDeviation deviation_from(const ExactSurface& surface, const Points& X, const Triangles& F);

}  // namespace ibmfair
