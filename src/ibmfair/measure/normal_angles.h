// Angles between normals.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/measure/statistics.h"

namespace ibmfair {

/// The angle between two vectors of any length, in degrees, accurate also near 0 and 180 degrees;
/// NaN if one of the vectors is zero.
double degrees_between(const Vec3& a, const Vec3& b);

/// Statistics of the angles between pairs of normals.
struct NormalAngles {
  Statistics degrees;  ///< `where` is the number of the pair
  Index flipped = 0;   ///< pairs with an angle above 90 degrees
  Index left_out = 0;  ///< pairs without an angle, because a face without area has no normal
};

/// NaN angles (degrees) are left out.
NormalAngles summarise_angles(const Eigen::VectorXd& degrees);

}  // namespace ibmfair
