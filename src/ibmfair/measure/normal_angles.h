// Angles between normals.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/measure/statistics.h"

namespace ibmfair {

/// The angle between two directions of any length, degrees, accurate for the smallest and largest
/// ones too; NaN where one of them is zero.
double degrees_between(const Vec3& a, const Vec3& b);

/// What the angles of many pairs of normals come down to.
struct NormalAngles {
  Statistics degrees;  ///< `where` is the number of the pair
  Index flipped = 0;   ///< pairs with an angle above 90 degrees
  Index left_out = 0;  ///< pairs without an angle: a face without area has no normal
};

/// NaN angles (degrees) are left out.
NormalAngles summarise_angles(const Eigen::VectorXd& degrees);

}  // namespace ibmfair
