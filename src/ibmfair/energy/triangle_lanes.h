// What the kernels of the energies share: several triangles of a block at a time, one in each lane.
// For the .cpp files of kernels only, as base/lanes.h.
#pragma once

#include "ibmfair/base/lanes.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// How many triangles a kernel takes through one of its stages before the next. Square roots and
/// divisions take so long that they must be under way for many triangles at once, and of long
/// stages only the work on a few has room in the processor's queue.
inline constexpr std::int64_t run_length = 64;

/// Where a block lists the first places of triangle t and of those after it in its group. The
/// second ones stand `lanes_per_group` further on, and the third ones as far behind these.
IBMFAIR_INLINE const Index* places_of(const Index* listed, std::int64_t t) {
  return listed + 3 * t - 2 * (t % lanes_per_group);
}

/// The rows of a triangle's three corners, or of what else it has three of.
template <class Lanes>
struct ThreeRows {
  Lanes4<Lanes> first, second, third;
};

template <class Lanes>
IBMFAIR_INLINE ThreeRows<Lanes> gather_three(const double* rows, const Index* at) {
  const Index *at_second = at + lanes_per_group, *at_third = at_second + lanes_per_group;
  return {gather<Lanes>(rows, at), gather<Lanes>(rows, at_second), gather<Lanes>(rows, at_third)};
}

namespace simd_detail {

IBMFAIR_INLINE void add(const Four& a, double* to) {
  Four sum;
  std::memcpy(&sum, to, sizeof sum);
  sum += a;
  std::memcpy(to, &sum, sizeof sum);
}

/// One triangle after the other, for their corners may coincide; and all three of one before the
/// next, so that sums do not depend on which of them comes first.
template <int count>
IBMFAIR_INLINE void add_rows(const Four (&a)[count], const Four (&b)[count], const Four (&c)[count],
                             double* rows, const Index* at) {
  for (int i = 0; i < count; ++i) {
    add(a[i], rows + at[i]);
    add(b[i], rows + at[lanes_per_group + i]);
    add(c[i], rows + at[2 * lanes_per_group + i]);
  }
}

}  // namespace simd_detail

/// Adds b and c to the rows of the second and the third corner, and -(b + c) to those of the first:
/// three forces that sum to 0.
template <class Lanes>
IBMFAIR_INLINE void scatter_add_balanced(const Lanes3<Lanes>& b, const Lanes3<Lanes>& c,
                                         double* rows, const Index* at) {
  Four row_a[lane_count<Lanes>], row_b[lane_count<Lanes>], row_c[lane_count<Lanes>];
  rows_of(b, Lanes{}, row_b);
  rows_of(c, Lanes{}, row_c);
  for (int i = 0; i < lane_count<Lanes>; ++i) {
    row_a[i] = -(row_b[i] + row_c[i]);
  }
  simd_detail::add_rows(row_a, row_b, row_c, rows, at);
}

}  // namespace ibmfair
