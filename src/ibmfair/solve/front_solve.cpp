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

template <class Real>
using Quadruple = typename QuadOf<Real>::type;

/// Rows of quads that fill 32 bytes, which loops over rows take at a time.
template <class Real>
struct PackOf;
template <>
struct PackOf<float> {
  using type __attribute__((vector_size(32))) = float;
  static constexpr Index rows = 2;
};
template <>
struct PackOf<double> {
  using type = Quadruple<double>;
  static constexpr Index rows = 1;
};
template <class Real>
using Pack = typename PackOf<Real>::type;

/// In every row of a pack the same quad.
IBMFAIR_INLINE Pack<float> repeat(const Quadruple<float>& quad) {
  return __builtin_shufflevector(quad, quad, 0, 1, 2, 3, 0, 1, 2, 3);
}
IBMFAIR_INLINE Pack<double> repeat(const Quadruple<double>& quad) {
  return quad;
}

/// What to multiply a pack by: in every row of it four times the next number. Both floats are read
/// as one, which costs no more than one of them would.
IBMFAIR_INLINE Pack<float> spread(const float* numbers) {
  double both;
  std::memcpy(&both, numbers, sizeof both);
  const Quadruple<double> copies = {both, both, both, both};
  Pack<float> pack;
  std::memcpy(&pack, &copies, sizeof pack);
  return __builtin_shufflevector(pack, pack, 0, 0, 0, 0, 5, 5, 5, 5);
}
IBMFAIR_INLINE double spread(const double* number) {
  return *number;
}

/// The sum of the rows of a pack.
IBMFAIR_INLINE Quadruple<float> sum_of_rows(const Pack<float>& pack) {
  return __builtin_shufflevector(pack, pack, 0, 1, 2, 3) +
         __builtin_shufflevector(pack, pack, 4, 5, 6, 7);
}
IBMFAIR_INLINE Quadruple<double> sum_of_rows(const Pack<double>& pack) {
  return pack;
}

/// A list of quads in memory that need not be aligned.
template <class Real>
class QuadList {
 public:
  IBMFAIR_INLINE explicit QuadList(Real* numbers) : numbers_(numbers) {}
  /// The quad at i, or the pack from there on.
  template <class Rows = Quadruple<Real>>
  IBMFAIR_INLINE Rows get(Index i) const {
    Rows rows;
    std::memcpy(&rows, numbers_ + 4 * std::size_t(i), sizeof rows);
    return rows;
  }
  template <class Rows>
  IBMFAIR_INLINE void set(Index i, const Rows& rows) {
    std::memcpy(numbers_ + 4 * std::size_t(i), &rows, sizeof rows);
  }

 private:
  Real* numbers_;
};

// Both directions read every entry of the block once, and are bound by that: with four columns at a
// time the quads beside it are read a quarter as often.

template <class Real>
struct Forward {
  static constexpr Index pack_rows = PackOf<Real>::rows;

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
      const auto P = repeat(p), Q = repeat(q), R = repeat(r), S = repeat(s);
      Index i = j + 4;
      for (; i + pack_rows <= rows; i += pack_rows) {
        const auto w = W.template get<Pack<Real>>(i);
        W.set(i,
              w - (spread(a + i) * P + spread(b + i) * Q + spread(c + i) * R + spread(d + i) * S));
      }
      for (; i < rows; ++i) {
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
  static constexpr Index pack_rows = PackOf<Real>::rows;

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
      Pack<Real> P = {}, Q = {}, R = {}, S = {};
      Index i = j + 4;
      for (; i + pack_rows <= rows; i += pack_rows) {
        const auto w = W.template get<Pack<Real>>(i);
        P += spread(a + i) * w, Q += spread(b + i) * w;
        R += spread(c + i) * w, S += spread(d + i) * w;
      }
      auto p = W.get(j) - sum_of_rows(P), q = W.get(j + 1) - sum_of_rows(Q);
      auto r = W.get(j + 2) - sum_of_rows(R), s = W.get(j + 3) - sum_of_rows(S);
      for (; i < rows; ++i) {
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
