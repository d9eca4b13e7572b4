// The sphere that best fits a set of points.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

struct SphereFit {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;     ///< mean distance of the points from the centre, length
  double deviation = 0.0;  ///< standard deviation of these distances / their mean
};

/// Minimises the sum of (|x - center| - radius)^2 over the rows of X (#V x 3) by Gauss-Newton
/// iterations, starting from the algebraic fit. All points have equal weight. Throws BadMesh for
/// fewer than four points and for coplanar points, which have no best-fitting sphere.
SphereFit fit_sphere(const Points& X);

}  // namespace ibmfair
