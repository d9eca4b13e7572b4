// Conversions between the two layouts of vectors: rows of four numbers, which are passed from front
// to front, and packs of rows, which the kernels of substitution use: coordinate by coordinate, one
// number of each row. For .cpp files of kernels only, as base/lanes.h.
#pragma once

#include <cstddef>

#include "ibmfair/base/types.h"
#include "ibmfair/solve/front_kernels.h"
#include "ibmfair/solve/row_vectors.h"

namespace ibmfair {

/// The three coordinates of a pack of rows.
template <class Real>
struct Pack3 {
  Pack<Real> c[3];
};

/// Interleaves the lower two (zip_low) or upper two (zip_high) of every four numbers of a and b.
IBMFAIR_INLINE Pack<float> zip_low(const Pack<float>& a, const Pack<float>& b) {
  return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
}
IBMFAIR_INLINE Pack<float> zip_high(const Pack<float>& a, const Pack<float>& b) {
  return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
}
IBMFAIR_INLINE Pack<double> zip_low(const Pack<double>& a, const Pack<double>& b) {
  return __builtin_shufflevector(a, b, 0, 4, 2, 6);
}
IBMFAIR_INLINE Pack<double> zip_high(const Pack<double>& a, const Pack<double>& b) {
  return __builtin_shufflevector(a, b, 1, 5, 3, 7);
}

/// Interleaves two packs by pairs of numbers.
IBMFAIR_INLINE Pack<float> zip_low_pairs(const Pack<float>& a, const Pack<float>& b) {
  return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
IBMFAIR_INLINE Pack<float> zip_high_pairs(const Pack<float>& a, const Pack<float>& b) {
  return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}
IBMFAIR_INLINE Pack<double> zip_low_pairs(const Pack<double>& a, const Pack<double>& b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5);
}
IBMFAIR_INLINE Pack<double> zip_high_pairs(const Pack<double>& a, const Pack<double>& b) {
  return __builtin_shufflevector(a, b, 2, 3, 6, 7);
}

/// The sums of the numbers of each of four packs.
IBMFAIR_INLINE Row4<float> sums(const Pack<float>& a, const Pack<float>& b, const Pack<float>& c,
                                const Pack<float>& d) {
  const Pack<float> ab = zip_low(a, b) + zip_high(a, b), cd = zip_low(c, d) + zip_high(c, d);
  const Pack<float> abcd = zip_low_pairs(ab, cd) + zip_high_pairs(ab, cd);
  return low_half(abcd) + high_half(abcd);
}
IBMFAIR_INLINE Row4<double> sums(const Pack<double>& a, const Pack<double>& b,
                                 const Pack<double>& c, const Pack<double>& d) {
  const Pack<double> ab = zip_low(a, b) + zip_high(a, b), cd = zip_low(c, d) + zip_high(c, d);
  return zip_low_pairs(ab, cd) + zip_high_pairs(ab, cd);
}

/// Consecutive rows of four numbers, `count` of them; rows beyond are zero.
template <class Real>
struct RowsInTurn {
  const Real* first;
  Index count;
  IBMFAIR_INLINE Row4<Real> operator[](Index i) const {
    return i < count ? load<Row4<Real>>(first + 4 * std::ptrdiff_t{i}) : Row4<Real>{};
  }
};

/// The rows of x (four numbers each) that `row` lists, `count` of them; rows beyond are zero.
template <class Real>
struct NamedRows {
  const Real* x;
  const Index* row;
  Index count;
  IBMFAIR_INLINE Row4<Real> operator[](Index i) const {
    return i < count ? load<Row4<Real>>(x + 4 * std::ptrdiff_t{row[i]}) : Row4<Real>{};
  }
};

/// Loads the rows first, first + 1, ... into one pack.
template <class CompressedRows>
IBMFAIR_INLINE Pack3<float> to_packs(const CompressedRows& rows, Index first, float /*tag*/) {
  const Pack<float> a = both_halves(rows[first], rows[first + 4]);
  const Pack<float> b = both_halves(rows[first + 1], rows[first + 5]);
  const Pack<float> c = both_halves(rows[first + 2], rows[first + 6]);
  const Pack<float> d = both_halves(rows[first + 3], rows[first + 7]);
  const Pack<float> xy01 = zip_low(a, b), xy23 = zip_low(c, d);
  const Pack<float> z01 = zip_high(a, b), z23 = zip_high(c, d);
  return {zip_low_pairs(xy01, xy23), zip_high_pairs(xy01, xy23), zip_low_pairs(z01, z23)};
}
template <class CompressedRows>
IBMFAIR_INLINE Pack3<double> to_packs(const CompressedRows& rows, Index first, double /*tag*/) {
  const Pack<double> a = rows[first], b = rows[first + 1];
  const Pack<double> c = rows[first + 2], d = rows[first + 3];
  const Pack<double> xz01 = zip_low(a, b), xz23 = zip_low(c, d);
  const Pack<double> y01 = zip_high(a, b), y23 = zip_high(c, d);
  return {zip_low_pairs(xz01, xz23), zip_low_pairs(y01, y23), zip_high_pairs(xz01, xz23)};
}

/// The inverse of to_packs: stores rows of four numbers, the fourth of which is zero.
IBMFAIR_INLINE void to_rows(const Pack3<float>& pack, float* rows) {
  const auto& [x, y, z] = pack.c;
  const Pack<float> none = {};
  const Pack<float> xy01 = zip_low(x, y), xy23 = zip_high(x, y);
  const Pack<float> z01 = zip_low(z, none), z23 = zip_high(z, none);
  const Pack<float> two[] = {zip_low_pairs(xy01, z01), zip_high_pairs(xy01, z01),
                             zip_low_pairs(xy23, z23), zip_high_pairs(xy23, z23)};
  for (std::ptrdiff_t i = 0; i < 4; ++i) {
    store(rows + 4 * i, low_half(two[i]));
    store(rows + 4 * (i + 4), high_half(two[i]));
  }
}
IBMFAIR_INLINE void to_rows(const Pack3<double>& pack, double* rows) {
  const auto& [x, y, z] = pack.c;
  const Pack<double> none = {};
  const Pack<double> xy02 = zip_low(x, y), xy13 = zip_high(x, y);
  const Pack<double> z02 = zip_low(z, none), z13 = zip_high(z, none);
  store(rows, zip_low_pairs(xy02, z02));
  store(rows + 4, zip_low_pairs(xy13, z13));
  store(rows + 8, zip_high_pairs(xy02, z02));
  store(rows + 12, zip_high_pairs(xy13, z13));
}

}  // namespace ibmfair
