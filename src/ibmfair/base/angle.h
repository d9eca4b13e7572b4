// Conversion of angles. The code computes in radians; people read and write degrees.
#pragma once

#include <numbers>

namespace ibmfair {

constexpr double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

}  // namespace ibmfair
