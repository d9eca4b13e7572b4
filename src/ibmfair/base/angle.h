// Angles between directions, and conversion of angles. The code computes in radians; people read
// and write degrees.
#pragma once

#include <cmath>
#include <numbers>

#include "ibmfair/base/types.h"

namespace ibmfair {

constexpr double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// The angle between two directions of any length, radians in [0, pi]; exact for small angles. 0 if
/// one of them is zero.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace ibmfair
