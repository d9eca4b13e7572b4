// SIMD vectors for the kernels of solvers: rows of four numbers (three coordinates and an unused
// number), and packs of 32 bytes. For .cpp files of kernels only, as base/lanes.h.
#pragma once

#include "ibmfair/base/simd.h"

namespace ibmfair {

template <class Real>
struct VectorsOf;
template <>
struct VectorsOf<float> {
  using Row4 __attribute__((vector_size(16))) = float;
  using Pack __attribute__((vector_size(32))) = float;
};
template <>
struct VectorsOf<double> {
  using Row4 __attribute__((vector_size(32))) = double;
  using Pack = Row4;
};

/// A row of four numbers.
template <class Real>
using Row4 = typename VectorsOf<Real>::Row4;
/// As many numbers as 32 bytes hold.
template <class Real>
using Pack = typename VectorsOf<Real>::Pack;

IBMFAIR_INLINE Pack<float> both_halves(const Row4<float>& low, const Row4<float>& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
IBMFAIR_INLINE Row4<float> low_half(const Pack<float>& a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}
IBMFAIR_INLINE Row4<float> high_half(const Pack<float>& a) {
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

}  // namespace ibmfair
