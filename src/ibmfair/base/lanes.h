// Four numbers at a time, for the kernels that measurably need it (base/simd.h). Only additions,
// multiplications, divisions and square roots are used, lane by lane and none fused, so that all
// versions of a kernel give the same bytes.
//
// For .cpp files of kernels only. Vectors are wider than the baseline's registers, so they must not
// cross a border between functions that are not inlined: kernels take pointers and numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ibmfair/base/simd.h"

// GCC warns of that border even where everything is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace ibmfair {

inline constexpr int lane_count = 4;

/// How many groups of four a kernel takes through one of its stages before the next. Square roots
/// and divisions take so long that they must be under way for several groups at once; in one long
/// stage the rest of the work on a group would fill up the processor's queue.
inline constexpr std::int64_t run_length = 16;

using Lanes = double __attribute__((vector_size(8 * lane_count)));

IBMFAIR_INLINE Lanes sqrt(const Lanes& a) {
  return Lanes{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]),
               __builtin_sqrt(a[3])};
}

IBMFAIR_INLINE double sum(const Lanes& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

/// b where it is not a number.
IBMFAIR_INLINE Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

IBMFAIR_INLINE double largest(const Lanes& a) {
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

/// Four vectors of space.
struct Lanes3 {
  Lanes x, y, z;
};

IBMFAIR_INLINE Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
IBMFAIR_INLINE Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
IBMFAIR_INLINE Lanes3 operator-(const Lanes3& a) {
  return {-a.x, -a.y, -a.z};
}
IBMFAIR_INLINE Lanes3 operator*(const Lanes& s, const Lanes3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
IBMFAIR_INLINE Lanes3 operator/(const Lanes3& a, const Lanes& s) {
  return {a.x / s, a.y / s, a.z / s};
}
IBMFAIR_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
IBMFAIR_INLINE Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Four rows of four numbers, turned: a vector of space and one number more in each lane.
struct Lanes4 {
  Lanes3 xyz;
  Lanes w;
};

namespace simd_detail {

/// Numbers at `p`, which need not be aligned.
using HalfAt = double __attribute__((vector_size(16), aligned(8), may_alias));
using LanesAt = double __attribute__((vector_size(8 * lane_count), aligned(8), may_alias));

/// The two numbers at `a` and at `b` as one. The shuffles that remain are the cheap ones, within
/// halves; and as four numbers are read at `b`, the compiler inserts two of them from memory, with
/// no shuffle at all.
IBMFAIR_INLINE Lanes halves(const double* a, const double* b) {
  const HalfAt& low = *reinterpret_cast<const HalfAt*>(a);
  return __builtin_shufflevector(__builtin_shufflevector(low, low, 0, 1, -1, -1),
                                 *reinterpret_cast<const LanesAt*>(b), 0, 1, 4, 5);
}

IBMFAIR_INLINE void add(const Lanes& a, double* to) {
  Lanes sum;
  std::memcpy(&sum, to, sizeof sum);
  sum += a;
  std::memcpy(to, &sum, sizeof sum);
}

}  // namespace simd_detail

/// Lane i from the row `rows + at[i]`. Reads two numbers more behind a row, and drops them: behind
/// the last row there must be room.
IBMFAIR_INLINE Lanes4 gather(const double* rows, const std::int32_t* at) {
  const double* r0 = rows + at[0];
  const double* r1 = rows + at[1];
  const double* r2 = rows + at[2];
  const double* r3 = rows + at[3];
  const Lanes xy02 = simd_detail::halves(r0, r2), xy13 = simd_detail::halves(r1, r3);
  const Lanes zw02 = simd_detail::halves(r0 + 2, r2 + 2);
  const Lanes zw13 = simd_detail::halves(r1 + 2, r3 + 2);
  return {{__builtin_shufflevector(xy02, xy13, 0, 4, 2, 6),
           __builtin_shufflevector(xy02, xy13, 1, 5, 3, 7),
           __builtin_shufflevector(zw02, zw13, 0, 4, 2, 6)},
          __builtin_shufflevector(zw02, zw13, 1, 5, 3, 7)};
}

/// The inverse of gather's turn: row i of four numbers out of lane i.
IBMFAIR_INLINE void rows_of(const Lanes3& a, const Lanes& w, Lanes* row) {
  const Lanes xy02 = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);
  const Lanes xy13 = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);
  const Lanes zw02 = __builtin_shufflevector(a.z, w, 0, 4, 2, 6);
  const Lanes zw13 = __builtin_shufflevector(a.z, w, 1, 5, 3, 7);
  row[0] = __builtin_shufflevector(xy02, zw02, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(xy13, zw13, 0, 1, 4, 5);
  row[2] = __builtin_shufflevector(xy02, zw02, 2, 3, 6, 7);
  row[3] = __builtin_shufflevector(xy13, zw13, 2, 3, 6, 7);
}

/// Adds lane i of a, b and c, each with w, to the rows `rows + at[i]`, `rows + at[4 + i]` and
/// `rows + at[8 + i]`. One lane after the other, for rows may coincide; and all three of a lane
/// before the next, so that sums do not depend on which of them comes first.
IBMFAIR_INLINE void scatter_add(const Lanes3& a, const Lanes3& b, const Lanes3& c, const Lanes& w,
                                double* rows, const std::int32_t* at) {
  Lanes row_a[lane_count], row_b[lane_count], row_c[lane_count];
  rows_of(a, w, row_a);
  rows_of(b, w, row_b);
  rows_of(c, w, row_c);
  for (int i = 0; i < lane_count; ++i) {
    simd_detail::add(row_a[i], rows + at[i]);
    simd_detail::add(row_b[i], rows + at[lane_count + i]);
    simd_detail::add(row_c[i], rows + at[2 * lane_count + i]);
  }
}

/// The same for a = -(b + c) and no w: three forces that sum to 0.
IBMFAIR_INLINE void scatter_add_balanced(const Lanes3& b, const Lanes3& c, double* rows,
                                         const std::int32_t* at) {
  Lanes row_b[lane_count], row_c[lane_count];
  rows_of(b, Lanes{}, row_b);
  rows_of(c, Lanes{}, row_c);
  for (int i = 0; i < lane_count; ++i) {
    simd_detail::add(-(row_b[i] + row_c[i]), rows + at[i]);
    simd_detail::add(row_b[i], rows + at[lane_count + i]);
    simd_detail::add(row_c[i], rows + at[2 * lane_count + i]);
  }
}

/// Writes lane i to the row `rows + 4 * i`. One by one: GCC would take a copy of them all through
/// the processor's integers.
IBMFAIR_INLINE void store_rows(const Lanes3& a, const Lanes& w, double* rows) {
  Lanes row[lane_count];
  rows_of(a, w, row);
  for (const Lanes& four : row) {
    std::memcpy(rows, &four, sizeof four);
    rows += lane_count;
  }
}

}  // namespace ibmfair
