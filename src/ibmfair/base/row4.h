// Rows of four numbers, the unit in which kernels gather data (base/lanes.h).
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A vector in space and one more number.
struct alignas(32) Row4 {
  double x = 0, y = 0, z = 0, w = 0;

  Vec3 xyz() const { return {x, y, z}; }
};

/// The numbers in one row. Offsets that kernels use (gather() in base/lanes.h) count numbers, not
/// rows.
inline constexpr Index row_size = sizeof(Row4) / sizeof(double);

}  // namespace ibmfair
