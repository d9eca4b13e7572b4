// Vectors of four numbers, for the kernels that are measurably faster with them. Only additions,
// multiplications, divisions and square roots are used, lane by lane, so that both versions of a
// kernel give the same bytes, except in the files for which CMakeLists.txt allows fused
// multiply-adds (base/simd.h).
//
// Include this header only in .cpp files of kernels. The vectors are wider than the registers of
// the baseline instruction set, so they must not be arguments or results of functions that are not
// inlined: kernels take pointers and numbers.
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

/// The larger of the two numbers in each lane; b if either of the two is not a number.
IBMFAIR_INLINE Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

IBMFAIR_INLINE double largest(const Lanes& a) {
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

/// Four vectors in space, one in each lane.
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

/// Four rows of four numbers, transposed: each lane holds a vector in space and one more number.
struct Lanes4 {
  Lanes3 xyz;
  Lanes w;
};

namespace simd_detail {

using Two = double __attribute__((vector_size(16)));

/// The two numbers at `a`, followed by the two at `b`, as one vector. Shuffles within the halves of
/// a vector, which are the cheap ones, then suffice; and because four numbers are read at `b`, the
/// compiler inserts two of them from memory without any shuffle.
IBMFAIR_INLINE Lanes halves(const double* a, const double* b) {
  const Two low = load<Two>(a);
  return __builtin_shufflevector(__builtin_shufflevector(low, low, 0, 1, -1, -1), load<Lanes>(b), 0,
                                 1, 4, 5);
}

}  // namespace simd_detail

/// The three numbers at `row`, followed by 0.
IBMFAIR_INLINE Lanes three_numbers(const double* row) {
  const simd_detail::Two high = {row[2], 0};
  return __builtin_shufflevector(load<simd_detail::Two>(row), high, 0, 1, 2, 3);
}

/// Fills lane i with the four numbers at `row[i]`. May read up to two numbers beyond each row,
/// which are ignored, so at least two more numbers must follow the last row in memory.
IBMFAIR_INLINE Lanes4 gather_rows(const double* const (&row)[lane_count]) {
  using simd_detail::halves;
  const Lanes xy02 = halves(row[0], row[2]), xy13 = halves(row[1], row[3]);
  const Lanes zw02 = halves(row[0] + 2, row[2] + 2), zw13 = halves(row[1] + 2, row[3] + 2);
  return {{__builtin_shufflevector(xy02, xy13, 0, 4, 2, 6),
           __builtin_shufflevector(xy02, xy13, 1, 5, 3, 7),
           __builtin_shufflevector(zw02, zw13, 0, 4, 2, 6)},
          __builtin_shufflevector(zw02, zw13, 1, 5, 3, 7)};
}

/// Fills lane i with the row at `rows + at[i]`; reads beyond the rows as gather_rows() does.
IBMFAIR_INLINE Lanes4 gather(const double* rows, const std::int32_t* at) {
  const double* row[lane_count];
  for (int i = 0; i < lane_count; ++i) {
    row[i] = rows + at[i];
  }
  return gather_rows(row);
}

/// Fills lane i with the row at `rows + stride * i`; reads beyond the rows as gather_rows() does.
IBMFAIR_INLINE Lanes4 load_rows(const double* rows, std::ptrdiff_t stride = 4) {
  const double* row[lane_count];
  for (const double*& start : row) {
    start = rows;
    rows += stride;
  }
  return gather_rows(row);
}

/// The inverse of gather_rows(): `row[i]` receives the four numbers of lane i.
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

/// Writes lane i to the row at `rows + stride * i`. The loop is unrolled because GCC would
/// otherwise copy all rows once more.
IBMFAIR_INLINE void store_rows(const Lanes3& a, const Lanes& w, double* rows,
                               std::ptrdiff_t stride = 4) {
  Lanes row[lane_count];
  rows_of(a, w, row);
#pragma GCC unroll 4
  for (std::ptrdiff_t i = 0; i < lane_count; ++i) {
    store(rows + stride * i, row[i]);
  }
}

/// In each lane, the number in `a` if the mask in `masks` is -1, and 0 if the mask is 0. The four
/// masks are listed one by one because only then does GCC widen all four at once.
IBMFAIR_INLINE Lanes where(const std::int8_t* masks, const Lanes& a) {
  using Bits = std::int64_t __attribute__((vector_size(32)));
  const Bits all = {masks[0], masks[1], masks[2], masks[3]};
  return __builtin_bit_cast(Lanes, __builtin_bit_cast(Bits, a) & all);
}

/// Adds `a` to the row of four numbers at `to`.
IBMFAIR_INLINE void add_to_row(const Lanes& a, double* to) {
  store(to, load<Lanes>(to) + a);
}

}  // namespace ibmfair
