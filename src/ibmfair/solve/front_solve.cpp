#include <cstring>

#include "ibmfair/base/simd.h"
#include "ibmfair/solve/front_kernels.h"

// No vector is passed between functions: all are part of the kernels at the end.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace ibmfair {
namespace {

/// Four numbers side by side: the three coordinates of a right-hand side, and one that is idle.
template <class Real>
struct QuadOf;
template <>
struct QuadOf<float> {
  using type __attribute__((vector_size(16))) = float;
};
template <>
struct QuadOf<double> {
  using type __attribute__((vector_size(32))) = double;
};

/// A list of quads in memory that need not be aligned.
template <class Real>
class QuadList {
 public:
  using Quad = typename QuadOf<Real>::type;
  IBMFAIR_INLINE explicit QuadList(Real* numbers) : numbers_(numbers) {}
  IBMFAIR_INLINE Quad get(Index i) const {
    Quad quad;
    std::memcpy(&quad, numbers_ + 4 * std::size_t(i), sizeof quad);
    return quad;
  }
  IBMFAIR_INLINE void set(Index i, const Quad& quad) {
    std::memcpy(numbers_ + 4 * std::size_t(i), &quad, sizeof quad);
  }

 private:
  Real* numbers_;
};

// Both directions read every entry of the block once, and are bound by that: with four columns at a
// time the quads beside it are read a quarter as often.

template <class Real>
struct Forward {
  IBMFAIR_INLINE static void run(const Real* L, Index rows, Index columns, Real* vectors) {
    QuadList<Real> W(vectors);
    Index j = 0;
    for (; j + 4 <= columns; j += 4) {
      const Real* a = L + std::int64_t{j} * rows;
      const Real *b = a + rows, *c = b + rows, *d = c + rows;
      const auto p = W.get(j) / a[j];
      const auto q = (W.get(j + 1) - a[j + 1] * p) / b[j + 1];
      const auto r = (W.get(j + 2) - a[j + 2] * p - b[j + 2] * q) / c[j + 2];
      const auto s = (W.get(j + 3) - a[j + 3] * p - b[j + 3] * q - c[j + 3] * r) / d[j + 3];
      W.set(j, p), W.set(j + 1, q), W.set(j + 2, r), W.set(j + 3, s);
      for (Index i = j + 4; i < rows; ++i) {
        W.set(i, W.get(i) - (a[i] * p + b[i] * q + c[i] * r + d[i] * s));
      }
    }
    for (; j < columns; ++j) {
      const Real* a = L + std::int64_t{j} * rows;
      const auto p = W.get(j) / a[j];
      W.set(j, p);
      for (Index i = j + 1; i < rows; ++i) {
        W.set(i, W.get(i) - a[i] * p);
      }
    }
  }
};

template <class Real>
struct Backward {
  IBMFAIR_INLINE static void run(const Real* L, Index rows, Index columns, Real* vectors) {
    QuadList<Real> W(vectors);
    Index j = columns;
    for (; j % 4 != 0; --j) {
      const Real* a = L + std::int64_t{j - 1} * rows;
      auto p = W.get(j - 1);
      for (Index i = j; i < rows; ++i) {
        p -= a[i] * W.get(i);
      }
      W.set(j - 1, p / a[j - 1]);
    }
    while (j > 0) {
      j -= 4;
      const Real* a = L + std::int64_t{j} * rows;
      const Real *b = a + rows, *c = b + rows, *d = c + rows;
      auto p = W.get(j), q = W.get(j + 1), r = W.get(j + 2), s = W.get(j + 3);
      for (Index i = j + 4; i < rows; ++i) {
        const auto w = W.get(i);
        p -= a[i] * w, q -= b[i] * w, r -= c[i] * w, s -= d[i] * w;
      }
      s = s / d[j + 3];
      r = (r - c[j + 3] * s) / c[j + 2];
      q = (q - b[j + 3] * s - b[j + 2] * r) / b[j + 1];
      p = (p - a[j + 3] * s - a[j + 2] * r - a[j + 1] * q) / a[j];
      W.set(j, p), W.set(j + 1, q), W.set(j + 2, r), W.set(j + 3, s);
    }
  }
};

}  // namespace

template <class Real>
void substitute_forward(const Real* block, Index rows, Index columns, Real* W) {
  run<Forward<Real>>(block, rows, columns, W);
}

template <class Real>
void substitute_backward(const Real* block, Index rows, Index columns, Real* W) {
  run<Backward<Real>>(block, rows, columns, W);
}

template void substitute_forward(const float*, Index, Index, float*);
template void substitute_forward(const double*, Index, Index, double*);
template void substitute_backward(const float*, Index, Index, float*);
template void substitute_backward(const double*, Index, Index, double*);

}  // namespace ibmfair
