// Four numbers at a time, for the kernels that measurably need it. Only additions, multiplications,
// divisions and square roots are used, lane by lane, so that both versions of a kernel give the
// same bytes, except where CMakeLists.txt lets products be fused (base/simd.h).
//
// For .cpp files of kernels only. Vectors are wider than the baseline's registers, so they must not
// cross a border between functions that are not inlined: kernels take pointers and numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ibmfair/base/simd.h"

namespace ibmfair {

using Lanes = double __attribute__((vector_size(32)));
inline constexpr int lane_count = sizeof(Lanes) / sizeof(double);

IBMFAIR_INLINE Lanes sqrt(const Lanes& a) {
  return Lanes{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]),
               __builtin_sqrt(a[3])};
}

IBMFAIR_INLINE double sum(const Lanes& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

/// In each lane the larger of two numbers; b where one of them is not a number.
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

/// Four rows of four numbers, transposed: a vector of space and one number more in each lane.
struct Lanes4 {
  Lanes3 xyz;
  Lanes w;
};

namespace simd_detail {

using Two = double __attribute__((vector_size(16)));

/// The two numbers at `a` and at `b` as one vector. The shuffles that remain are the cheap ones,
/// within halves; and as four numbers are read at `b`, the compiler inserts two of them from
/// memory, with no shuffle at all.
IBMFAIR_INLINE Lanes halves(const double* a, const double* b) {
  const Two low = load<Two>(a);
  return __builtin_shufflevector(__builtin_shufflevector(low, low, 0, 1, -1, -1), load<Lanes>(b), 0,
                                 1, 4, 5);
}

}  // namespace simd_detail

/// The three numbers at `row`, and 0.
IBMFAIR_INLINE Lanes three_numbers(const double* row) {
  const simd_detail::Two high = {row[2], 0};
  return __builtin_shufflevector(load<simd_detail::Two>(row), high, 0, 1, 2, 3);
}

/// Lane i from the four numbers at `row[i]`. May read two numbers more behind them, and drops
/// these: behind the last there must be room.
IBMFAIR_INLINE Lanes4 gather_rows(const double* const (&row)[lane_count]) {
  using simd_detail::halves;
  const Lanes xy02 = halves(row[0], row[2]), xy13 = halves(row[1], row[3]);
  const Lanes zw02 = halves(row[0] + 2, row[2] + 2), zw13 = halves(row[1] + 2, row[3] + 2);
  return {{__builtin_shufflevector(xy02, xy13, 0, 4, 2, 6),
           __builtin_shufflevector(xy02, xy13, 1, 5, 3, 7),
           __builtin_shufflevector(zw02, zw13, 0, 4, 2, 6)},
          __builtin_shufflevector(zw02, zw13, 1, 5, 3, 7)};
}

/// Lane i from the row `rows + at[i]`; reads behind it as gather_rows() does.
IBMFAIR_INLINE Lanes4 gather(const double* rows, const std::int32_t* at) {
  const double* row[lane_count];
  for (int i = 0; i < lane_count; ++i) {
    row[i] = rows + at[i];
  }
  return gather_rows(row);
}

/// Lane i from the row `rows + stride * i`; reads behind it as gather_rows() does.
IBMFAIR_INLINE Lanes4 load_rows(const double* rows, std::ptrdiff_t stride = 4) {
  const double* row[lane_count];
  for (const double*& start : row) {
    start = rows;
    rows += stride;
  }
  return gather_rows(row);
}

/// The inverse of gather_rows(): row i of four numbers out of lane i.
IBMFAIR_INLINE void rows_of(const Lanes3& a, const Lanes& w, Lanes (&row)[lane_count]) {
  const Lanes xy02 = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);
  const Lanes xy13 = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);
  const Lanes zw02 = __builtin_shufflevector(a.z, w, 0, 4, 2, 6);
  const Lanes zw13 = __builtin_shufflevector(a.z, w, 1, 5, 3, 7);
  row[0] = __builtin_shufflevector(xy02, zw02, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(xy13, zw13, 0, 1, 4, 5);
  row[2] = __builtin_shufflevector(xy02, zw02, 2, 3, 6, 7);
  row[3] = __builtin_shufflevector(xy13, zw13, 2, 3, 6, 7);
}

/// Writes lane i to the row `rows + stride * i`. Unrolled: GCC would copy them all once more.
IBMFAIR_INLINE void store_rows(const Lanes3& a, const Lanes& w, double* rows,
                               std::ptrdiff_t stride = 4) {
  Lanes row[lane_count];
  rows_of(a, w, row);
#pragma GCC unroll 4
  for (std::ptrdiff_t i = 0; i < lane_count; ++i) {
    store(rows + stride * i, row[i]);
  }
}

/// a where the lane's number at `masks` is -1, and 0 where it is 0. GCC widens all four at once
/// only where they are written one by one.
IBMFAIR_INLINE Lanes where(const std::int8_t* masks, const Lanes& a) {
  using Bits = std::int64_t __attribute__((vector_size(32)));
  const Bits all = {masks[0], masks[1], masks[2], masks[3]};
  return __builtin_bit_cast(Lanes, __builtin_bit_cast(Bits, a) & all);
}

/// Adds to the row at `to`.
IBMFAIR_INLINE void add_to_row(const Lanes& a, double* to) {
  store(to, load<Lanes>(to) + a);
}

}  // namespace ibmfair
