// Four or eight numbers at a time, for the kernels that measurably need it. Only additions,
// multiplications, divisions and square roots are used, lane by lane, so that all versions of a
// kernel give the same bytes; but for the baseline's, where a file has products fused.
//
// For .cpp files of kernels only. Vectors are wider than the baseline's registers, so they must not
// cross a border between functions that are not inlined: kernels take pointers and numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ibmfair/base/simd.h"

namespace ibmfair {

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

template <class Lanes>
inline constexpr int lane_count = sizeof(Lanes) / sizeof(double);

namespace simd_detail {

template <class Kernel, class Lanes>
struct InLanes {
  template <class... Arguments>
  IBMFAIR_INLINE static auto run(Arguments... arguments) {
    return Kernel::template run<Lanes>(arguments...);
  }
};

}  // namespace simd_detail

/// Kernel::run<Lanes>(arguments...), an IBMFAIR_INLINE function, as compiled for `kernel_set()`: in
/// Eight where that is one register, in Four elsewhere.
template <class Kernel, class... Arguments>
auto run_in_lanes(Arguments... arguments) {
#if IBMFAIR_HAS_AVX_KERNELS
  if (kernel_set() == InstructionSet::avx512) {
    return simd_detail::run_avx512<simd_detail::InLanes<Kernel, Eight>>(arguments...);
  }
#endif
  return run<simd_detail::InLanes<Kernel, Four>>(arguments...);
}

IBMFAIR_INLINE Four low_half(const Eight& a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}
IBMFAIR_INLINE Four high_half(const Eight& a) {
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
}
IBMFAIR_INLINE Eight both_halves(const Four& low, const Four& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

IBMFAIR_INLINE Four sqrt(const Four& a) {
  return Four{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]),
              __builtin_sqrt(a[3])};
}
IBMFAIR_INLINE Eight sqrt(const Eight& a) {
  return both_halves(sqrt(low_half(a)), sqrt(high_half(a)));
}

/// Adds four numbers to four sums, or eight as two times four.
IBMFAIR_INLINE void add_to(Four& sums, const Four& a) {
  sums += a;
}
IBMFAIR_INLINE void add_to(Four& sums, const Eight& a) {
  sums += low_half(a);
  sums += high_half(a);
}

IBMFAIR_INLINE double sum(const Four& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

/// b where it is not a number.
template <class Lanes>
IBMFAIR_INLINE Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

/// The same for four maxima.
IBMFAIR_INLINE void raise_to(Four& maxima, const Four& a) {
  maxima = larger(maxima, a);
}
IBMFAIR_INLINE void raise_to(Four& maxima, const Eight& a) {
  raise_to(maxima, low_half(a));
  raise_to(maxima, high_half(a));
}

IBMFAIR_INLINE double largest(const Four& a) {
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

/// Vectors of space.
template <class Lanes>
struct Lanes3 {
  Lanes x, y, z;
};

/// to = from, where `to` is in memory: GCC would copy the whole by way of memory, in halves.
template <class Lanes>
IBMFAIR_INLINE void copy(const Lanes3<Lanes>& from, Lanes3<Lanes>& to) {
  to.x = from.x;
  to.y = from.y;
  to.z = from.z;
}

template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> operator+(const Lanes3<Lanes>& a, const Lanes3<Lanes>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> operator-(const Lanes3<Lanes>& a, const Lanes3<Lanes>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> operator-(const Lanes3<Lanes>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> operator*(const Lanes& s, const Lanes3<Lanes>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> operator/(const Lanes3<Lanes>& a, const Lanes& s) {
  return {a.x / s, a.y / s, a.z / s};
}
template <class Lanes>
IBMFAIR_INLINE Lanes dot(const Lanes3<Lanes>& a, const Lanes3<Lanes>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Lanes>
IBMFAIR_INLINE Lanes3<Lanes> cross(const Lanes3<Lanes>& a, const Lanes3<Lanes>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Rows of four numbers, turned: a vector of space and one number more in each lane.
template <class Lanes>
struct Lanes4 {
  Lanes3<Lanes> xyz;
  Lanes w;
};

namespace simd_detail {

/// The two numbers at `a` and at `b` as one. The shuffles that remain are the cheap ones, within
/// halves; and as four numbers are read at `b`, the compiler inserts two of them from memory, with
/// no shuffle at all.
IBMFAIR_INLINE Four halves(const double* a, const double* b) {
  const Two low = load<Two>(a);
  return __builtin_shufflevector(__builtin_shufflevector(low, low, 0, 1, -1, -1), load<Four>(b), 0,
                                 1, 4, 5);
}

/// The four numbers at `a` and at `b` as one.
IBMFAIR_INLINE Eight fours(const double* a, const double* b) {
  return both_halves(load<Four>(a), load<Four>(b));
}

IBMFAIR_INLINE Lanes4<Four> turned(const double* const (&r)[4]) {
  const Four xy02 = halves(r[0], r[2]), xy13 = halves(r[1], r[3]);
  const Four zw02 = halves(r[0] + 2, r[2] + 2), zw13 = halves(r[1] + 2, r[3] + 2);
  return {{__builtin_shufflevector(xy02, xy13, 0, 4, 2, 6),
           __builtin_shufflevector(xy02, xy13, 1, 5, 3, 7),
           __builtin_shufflevector(zw02, zw13, 0, 4, 2, 6)},
          __builtin_shufflevector(zw02, zw13, 1, 5, 3, 7)};
}

IBMFAIR_INLINE Lanes4<Eight> turned(const double* const (&r)[8]) {
  const Eight r02 = fours(r[0], r[2]), r13 = fours(r[1], r[3]);
  const Eight r46 = fours(r[4], r[6]), r57 = fours(r[5], r[7]);
  const Eight xz0 = __builtin_shufflevector(r02, r13, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight yw0 = __builtin_shufflevector(r02, r13, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight xz4 = __builtin_shufflevector(r46, r57, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight yw4 = __builtin_shufflevector(r46, r57, 1, 9, 3, 11, 5, 13, 7, 15);
  return {{__builtin_shufflevector(xz0, xz4, 0, 1, 4, 5, 8, 9, 12, 13),
           __builtin_shufflevector(yw0, yw4, 0, 1, 4, 5, 8, 9, 12, 13),
           __builtin_shufflevector(xz0, xz4, 2, 3, 6, 7, 10, 11, 14, 15)},
          __builtin_shufflevector(yw0, yw4, 2, 3, 6, 7, 10, 11, 14, 15)};
}

}  // namespace simd_detail

/// The three numbers at `row`, and 0.
IBMFAIR_INLINE Four three_numbers(const double* row) {
  const Two high = {row[2], 0};
  return __builtin_shufflevector(load<Two>(row), high, 0, 1, 2, 3);
}

/// Lane i from the four numbers at `row[i]`. May read two numbers more behind them, and drops
/// these: behind the last there must be room.
template <class Lanes>
IBMFAIR_INLINE Lanes4<Lanes> gather_rows(const double* const (&row)[lane_count<Lanes>]) {
  return simd_detail::turned(row);
}

/// Lane i from the row `rows + at[i]`; the same is read behind it.
template <class Lanes>
IBMFAIR_INLINE Lanes4<Lanes> gather(const double* rows, const std::int32_t* at) {
  const double* row[lane_count<Lanes>];
  for (int i = 0; i < lane_count<Lanes>; ++i) {
    row[i] = rows + at[i];
  }
  return gather_rows<Lanes>(row);
}

/// Lane i from the row `rows + stride * i`; the same is read behind it.
template <class Lanes>
IBMFAIR_INLINE Lanes4<Lanes> load_rows(const double* rows, std::ptrdiff_t stride = 4) {
  const double* row[lane_count<Lanes>];
  for (const double*& start : row) {
    start = rows;
    rows += stride;
  }
  return simd_detail::turned(row);
}

/// The inverse of gather's turn: row i of four numbers out of lane i.
IBMFAIR_INLINE void rows_of(const Lanes3<Four>& a, const Four& w, Four (&row)[4]) {
  const Four xy02 = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);
  const Four xy13 = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);
  const Four zw02 = __builtin_shufflevector(a.z, w, 0, 4, 2, 6);
  const Four zw13 = __builtin_shufflevector(a.z, w, 1, 5, 3, 7);
  row[0] = __builtin_shufflevector(xy02, zw02, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(xy13, zw13, 0, 1, 4, 5);
  row[2] = __builtin_shufflevector(xy02, zw02, 2, 3, 6, 7);
  row[3] = __builtin_shufflevector(xy13, zw13, 2, 3, 6, 7);
}

IBMFAIR_INLINE void rows_of(const Lanes3<Eight>& a, const Eight& w, Four (&row)[8]) {
  const Eight xy0 = __builtin_shufflevector(a.x, a.y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight xy1 = __builtin_shufflevector(a.x, a.y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight zw0 = __builtin_shufflevector(a.z, w, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight zw1 = __builtin_shufflevector(a.z, w, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight r02 = __builtin_shufflevector(xy0, zw0, 0, 1, 8, 9, 2, 3, 10, 11);
  const Eight r46 = __builtin_shufflevector(xy0, zw0, 4, 5, 12, 13, 6, 7, 14, 15);
  const Eight r13 = __builtin_shufflevector(xy1, zw1, 0, 1, 8, 9, 2, 3, 10, 11);
  const Eight r57 = __builtin_shufflevector(xy1, zw1, 4, 5, 12, 13, 6, 7, 14, 15);
  row[0] = low_half(r02);
  row[1] = low_half(r13);
  row[2] = high_half(r02);
  row[3] = high_half(r13);
  row[4] = low_half(r46);
  row[5] = low_half(r57);
  row[6] = high_half(r46);
  row[7] = high_half(r57);
}

/// Writes lane i to the row `rows + stride * i`. Unrolled: GCC would copy them all once more.
template <class Lanes>
IBMFAIR_INLINE void store_rows(const Lanes3<Lanes>& a, const Lanes& w, double* rows,
                               std::ptrdiff_t stride = 4) {
  Four row[lane_count<Lanes>];
  rows_of(a, w, row);
#pragma GCC unroll 8
  for (std::ptrdiff_t i = 0; i < lane_count<Lanes>; ++i) {
    store(rows + stride * i, row[i]);
  }
}

/// a where the lane's number at `masks` is -1, and 0 where it is 0. GCC widens all four at once
/// only where they are written one by one.
IBMFAIR_INLINE Four where(const std::int8_t* masks, const Four& a) {
  using Bits = std::int64_t __attribute__((vector_size(32)));
  const Bits all = {masks[0], masks[1], masks[2], masks[3]};
  return reinterpret_cast<Four>(reinterpret_cast<Bits>(a) & all);
}
IBMFAIR_INLINE Eight where(const std::int8_t* masks, const Eight& a) {
  return both_halves(where(masks, low_half(a)), where(masks + 4, high_half(a)));
}

/// Adds to the row at `to`.
IBMFAIR_INLINE void add_to_row(const Four& a, double* to) {
  store(to, load<Four>(to) + a);
}

}  // namespace ibmfair
