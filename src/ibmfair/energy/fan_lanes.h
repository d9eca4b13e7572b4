// What the kernels that go through fans have in common. For .cpp files of kernels only.
#pragma once

#include <cstdint>

#include "ibmfair/base/lanes.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Where the vertices of a few fans side by side are listed.
struct FanPlaces {
  const Index* centre;
  Index triangles;

  IBMFAIR_INLINE const Index* rim(std::int64_t i) const {
    return centre + lanes_per_group * (i + 1);
  }
};

/// Calls begin(i), finish(i) and put(i) for each of `count` triangles, but begins the next one
/// before it puts this one. The processor looks ahead less far than from one triangle to the next:
/// where all that it sees waits for the first of a chain of operations, it stands still.
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

/// 1 / (2 |N|), from |N|^2 and |N|: a division by the first need not wait for the square root.
template <class Lanes>
IBMFAIR_INLINE Lanes half_inverse(const Lanes& squared, const Lanes& length) {
  return 0.5 / squared * length;
}

/// N / (2 |N|), from |N| and `inverse`, half_inverse(), to the last digit where N has one
/// coordinate only: in a plane z = 0 it is 1/2, and there is no curvature, not a little.
template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> half_unit(const Lanes3<Lanes>& N, const Lanes& length,
                                       const Lanes& inverse) {
  const Lanes3<Lanes> n = inverse * N;
  return n + (1.0 - 2.0 * inverse * length) * n;
}

/// Adds to the vertices of fans, all of four fans before any of the next four, so that sums are
/// made in the same order however many fit in a register.
template <class Lanes>
class VertexSums {
 public:
  IBMFAIR_INLINE explicit VertexSums(BlockVertex* vertices) : sums_(&vertices->sum.x) {}

  IBMFAIR_INLINE void add(const Lanes3<Lanes>& a, const Lanes& w, const Index* at) {
    Four row[lane_count<Lanes>];
    rows_of(a, w, row);
    for (int i = 0; i < at_once; ++i) {
      add_to_row(row[i], sums_ + at[i]);
    }
    for (int i = at_once; i < lane_count<Lanes>; ++i) {
      later_[count_++] = {row[i], sums_ + at[i]};
    }
  }

  IBMFAIR_INLINE void finish() {
    for (const Later* one = later_; one != later_ + count_; ++one) {
      add_to_row(one->row, one->to);
    }
  }

 private:
  static constexpr int at_once = 4, rows = longest_fan + 2;

  struct Later {
    Four row;
    double* to;
  };

  Later later_[rows * (lane_count<Lanes> - at_once) + 1];
  double* sums_;
  int count_ = 0;
};

}  // namespace ibmfair
