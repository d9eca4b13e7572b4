// The sphere that fits a set of points best.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

struct SphereFit {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;     ///< mean distance of the points to the centre, length
  double deviation = 0.0;  ///< standard deviation of these distances / their mean
};

/// Minimises the sum of (|x - center| - radius)^2 over the rows of X (#V x 3), by Gauss-Newton from
/// the algebraic fit. Every point counts the same. Throws BadMesh for fewer than four points and
/// for points in a plane, which no sphere fits best.
SphereFit fit_sphere(const Points& X);

}  // namespace ibmfair
