// Rows of numbers as kernels gather them (base/lanes.h).
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A vector of space and one number more.
struct alignas(32) Row4 {
  double x = 0, y = 0, z = 0, w = 0;

  Vec3 xyz() const { return {x, y, z}; }
};

/// Numbers in a row: the kernels' places count them.
inline constexpr Index row_size = sizeof(Row4) / sizeof(double);

}  // namespace ibmfair
