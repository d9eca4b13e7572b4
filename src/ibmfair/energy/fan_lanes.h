// Code shared by the kernels that loop over fans. For .cpp files of kernels only.
#pragma once

#include <cstdint>

#include "ibmfair/base/lanes.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

static_assert(fans_per_group == lane_count);

/// Where the vertices of the fans of a group are listed in the block.
struct FanPlaces {
  const Index* centre;
  Index triangles;

  IBMFAIR_INLINE const Index* rim(std::int64_t i) const {
    return centre + fans_per_group * (i + 1);
  }
};

/// Calls begin(i), finish(i) and put(i) for each of `count` triangles, but begins the next triangle
/// before it puts this one. The out-of-order window of the processor does not reach from one
/// triangle to the next: without the overlap, the processor stalls when all the instructions that
/// it sees wait for the first one of a dependency chain.
template <class Begin, class Finish, class Put>
IBMFAIR_INLINE void overlapping(Index count, const Begin& begin, const Finish& finish,
                                const Put& put) {
  begin(0);
  for (Index i = 0; i + 1 < count; ++i) {
    finish(i);
    begin(i + 1);
    put(i);
  }
  finish(count - 1);
  put(count - 1);
}

/// 1 / (2 |N|), from |N|^2 and |N|: the division by |N|^2 need not wait for the square root.
IBMFAIR_INLINE Lanes half_inverse(const Lanes& squared, const Lanes& length) {
  return 0.5 / squared * length;
}

/// N / (2 |N|), from |N| and `inverse` = half_inverse(). The result is exact to the last digit if N
/// has only one nonzero coordinate: in the plane z = 0 the coordinate is exactly 1/2, so the
/// curvature is exactly zero.
IBMFAIR_INLINE Lanes3 half_unit(const Lanes3& N, const Lanes& length, const Lanes& inverse) {
  const Lanes3 n = inverse * N;
  return n + (1.0 - 2.0 * inverse * length) * n;
}

IBMFAIR_INLINE Lanes3 load(const FanVectors& from) {
  return {load<Lanes>(from.x), load<Lanes>(from.y), load<Lanes>(from.z)};
}
IBMFAIR_INLINE void store(FanVectors& to, const Lanes3& a) {
  store(to.x, a.x);
  store(to.y, a.y);
  store(to.z, a.z);
}

/// Adds lane i of the vector and of the number to the sum of the vertex at[i].
IBMFAIR_INLINE void add_to_vertices(const Lanes3& a, const Lanes& w, const Index* at,
                                    BlockVertex* vertices) {
  Lanes row[lane_count];
  rows_of(a, w, row);
  for (int i = 0; i < lane_count; ++i) {
    add_to_row(row[i], &vertices->sum.x + at[i]);
  }
}

}  // namespace ibmfair
