#include <cstddef>
#include <cstring>

#include "ibmfair/base/parallel.h"
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

/// What to multiply a pack by: in every row of it four times the k-th number of a panel's row.
template <int k>
IBMFAIR_INLINE Pack<float> spread(const float* rows) {
  Pack<float> pack;
  std::memcpy(&pack, rows, sizeof pack);
  return __builtin_shufflevector(pack, pack, k, k, k, k, k + 4, k + 4, k + 4, k + 4);
}
template <int k>
IBMFAIR_INLINE double spread(const double* row) {
  return row[k];
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

template <class Real>
IBMFAIR_INLINE QuadList<Real> rest_of(Real* vectors, Index first) {
  return QuadList<Real>(vectors + 4 * std::size_t(first));
}

/// Vectors of more bytes leave the first cache too little room for the panels beside them, and the
/// processor no longer fetches these ahead.
constexpr std::size_t small_vectors = 12 * 1024;

/// Numbers of a panel that are fetched ahead then: 8 kB.
template <class Real>
constexpr std::ptrdiff_t ahead = 8192 / sizeof(Real);

template <class Real>
IBMFAIR_INLINE void fetch(const Real* numbers) {
  __builtin_prefetch(numbers, 0, 2);  // 2: not to the first cache
}

/// One panel of four columns or the last one of a front, and W from its first row on.
template <class Real, int width, bool fetching>
struct Panel {
  static constexpr Index pack_rows = PackOf<Real>::rows;

  /// Returns the end of the panel.
  IBMFAIR_INLINE static const Real* forward(const Real* L, Index rows, QuadList<Real> W) {
    Quadruple<Real> x[width];
    for (int k = 0; k < width; ++k, L += width) {
      x[k] = W.get(k);
      for (int m = 0; m < k; ++m) {
        x[k] -= L[m] * x[m];
      }
      x[k] /= L[k];
      W.set(k, x[k]);
    }
    Index i = width;
    if constexpr (width == panel_width) {
      const auto p = repeat(x[0]), q = repeat(x[1]), r = repeat(x[2]), s = repeat(x[3]);
      for (; i + pack_rows <= rows; i += pack_rows, L += pack_rows * width) {
        if (fetching) fetch(L + ahead<Real>);
        W.set(i, W.template get<Pack<Real>>(i) -
                     (spread<0>(L) * p + spread<1>(L) * q + spread<2>(L) * r + spread<3>(L) * s));
      }
    }
    for (; i < rows; ++i, L += width) {
      auto sum = L[0] * x[0];
      for (int k = 1; k < width; ++k) {
        sum += L[k] * x[k];
      }
      W.set(i, W.get(i) - sum);
    }
    return L;
  }

  /// Begins at the end of the panel, and returns its start.
  IBMFAIR_INLINE static const Real* backward(const Real* L, Index rows, QuadList<Real> W) {
    Quadruple<Real> x[width] = {};
    Index i = rows;
    if constexpr (width == panel_width) {
      Pack<Real> p = {}, q = {}, r = {}, s = {};
      for (; i - pack_rows >= width; i -= pack_rows) {
        L -= pack_rows * width;
        if (fetching) fetch(L - ahead<Real>);
        const auto w = W.template get<Pack<Real>>(i - pack_rows);
        p += spread<0>(L) * w, q += spread<1>(L) * w;
        r += spread<2>(L) * w, s += spread<3>(L) * w;
      }
      x[0] = sum_of_rows(p), x[1] = sum_of_rows(q), x[2] = sum_of_rows(r), x[3] = sum_of_rows(s);
    }
    for (; i > width; --i) {
      L -= width;
      const auto w = W.get(i - 1);
      for (int k = 0; k < width; ++k) {
        x[k] += L[k] * w;
      }
    }
    L -= width * width;
    for (int k = width - 1; k >= 0; --k) {
      x[k] = W.get(k) - x[k];
      for (int m = width - 1; m > k; --m) {
        x[k] -= L[width * m + k] * x[m];
      }
      x[k] /= L[width * k + k];
      W.set(k, x[k]);
    }
    return L;
  }
};

template <class Real, bool fetching>
struct Forward {
  IBMFAIR_INLINE static void run(const Real* L, Index rows, Index columns, Real* vectors) {
    Index j = 0;
    for (; j + panel_width <= columns; j += panel_width) {
      L = Panel<Real, panel_width, fetching>::forward(L, rows - j, rest_of(vectors, j));
    }
    switch (columns - j) {
      case 1:
        Panel<Real, 1, fetching>::forward(L, rows - j, rest_of(vectors, j));
        break;
      case 2:
        Panel<Real, 2, fetching>::forward(L, rows - j, rest_of(vectors, j));
        break;
      case 3:
        Panel<Real, 3, fetching>::forward(L, rows - j, rest_of(vectors, j));
        break;
      default:
        break;
    }
  }
};

template <class Real, bool fetching>
struct Backward {
  IBMFAIR_INLINE static void run(const Real* L, Index rows, Index columns, Real* vectors) {
    L += packed_size(rows, columns);
    Index j = columns - columns % panel_width;
    switch (columns - j) {
      case 1:
        L = Panel<Real, 1, fetching>::backward(L, rows - j, rest_of(vectors, j));
        break;
      case 2:
        L = Panel<Real, 2, fetching>::backward(L, rows - j, rest_of(vectors, j));
        break;
      case 3:
        L = Panel<Real, 3, fetching>::backward(L, rows - j, rest_of(vectors, j));
        break;
      default:
        break;
    }
    while (j > 0) {
      j -= panel_width;
      L = Panel<Real, panel_width, fetching>::backward(L, rows - j, rest_of(vectors, j));
    }
  }
};

/// Numbers of a front.
constexpr std::int64_t worth_sharing_packing = 1'000'000;

template <class Real>
bool is_large(Index rows) {
  return 4 * sizeof(Real) * static_cast<std::size_t>(rows) > small_vectors;
}

}  // namespace

template <class Real>
void pack_front(const Real* block, Index rows, Index columns, Real* packed) {
  const Index full = columns / panel_width, rest = full * panel_width;
  const auto pack_panel = [&](std::int64_t p) {
    const Index first = static_cast<Index>(p) * panel_width;
    const Real* a = block + std::int64_t{first} * rows;
    const Real *b = a + rows, *c = b + rows, *d = c + rows;
    Real* to = packed + packed_size(rows, first);
    for (Index i = first; i < rows; ++i, to += panel_width) {
      to[0] = a[i], to[1] = b[i], to[2] = c[i], to[3] = d[i];
    }
  };
  run_tasks(full, packed_size(rows, columns) >= worth_sharing_packing, pack_panel);
  Real* to = packed + packed_size(rows, rest);
  for (Index i = rest; i < rows; ++i) {
    for (Index k = rest; k < columns; ++k) {
      *to++ = block[i + std::int64_t{k} * rows];
    }
  }
}

template <class Real>
void substitute_forward(const Real* packed, Index rows, Index columns, Real* W) {
  if (is_large<Real>(rows)) {
    run<Forward<Real, true>>(packed, rows, columns, W);
  } else {
    run<Forward<Real, false>>(packed, rows, columns, W);
  }
}

template <class Real>
void substitute_backward(const Real* packed, Index rows, Index columns, Real* W) {
  if (is_large<Real>(rows)) {
    run<Backward<Real, true>>(packed, rows, columns, W);
  } else {
    run<Backward<Real, false>>(packed, rows, columns, W);
  }
}

template void pack_front(const float*, Index, Index, float*);
template void pack_front(const double*, Index, Index, double*);
template void substitute_forward(const float*, Index, Index, float*);
template void substitute_forward(const double*, Index, Index, double*);
template void substitute_backward(const float*, Index, Index, float*);
template void substitute_backward(const double*, Index, Index, double*);

}  // namespace ibmfair
