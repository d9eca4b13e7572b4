#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/flush_subnormals.h"
#include "ibmfair/solve/front_packs.h"

namespace ibmfair {
namespace {

/// Columns in a strip. A strip is factored before its products are subtracted from the columns to
/// its right. It is so narrow that the rows of a band stay in the first-level cache.
constexpr Index strip_width = 128;

/// Packs in a band, the part of a front that a thread processes at a time.
constexpr Index band_packs = 6;

/// The number of multiplications that take longer than waking a thread.
constexpr double worth_sharing_front = 2e6;

/// The products to be subtracted from some packs of rows of a block A, in the columns of one panel.
/// For three packs these are twelve vectors; together with the operands they fill the sixteen
/// registers of AVX2.
template <class Real, int packs>
struct Tile {
  static constexpr Index pack = pack_rows<Real>;

  Pack<Real> sum[packs][panel_width];

  /// A B^T over `count` columns. The packs of A are `stride` apart; B is four rows of a pack.
  IBMFAIR_INLINE static Tile product(const Real* A, std::ptrdiff_t stride, const Real* B,
                                     Index count) {
    Tile tile = {};
    for (; count > 0; --count, A += pack, B += pack) {
      Pack<Real> a[packs];
      for (int p = 0; p < packs; ++p) {
        a[p] = load<Pack<Real>>(A + p * stride);
      }
      for (int c = 0; c < panel_width; ++c) {
        for (int p = 0; p < packs; ++p) {
          tile.sum[p][c] += a[p] * B[c];
        }
      }
    }
    return tile;
  }
};

/// Calls step.template tile<packs>(p) for tiles that cover the packs first .. last - 1.
template <class Step>
IBMFAIR_INLINE void in_tiles(Index first, Index last, const Step& step) {
  for (; first + 3 <= last; first += 3) {
    step.template tile<3>(first);
  }
  if (last - first == 2) step.template tile<2>(first);
  if (last - first == 1) step.template tile<1>(first);
}

/// One panel of a strip; all columns of the strip to its left are factored.
template <class Real>
struct Panel {
  static constexpr Index pack = pack_rows<Real>;

  FrontLayout<Real> front;
  Real* block;
  Index strip, column;  // first columns of the strip and of the panel
  Real* inverse;        // inverse diagonal; 0 for padding columns

  /// The four rows with the numbers of the panel's columns, from column 0 on.
  IBMFAIR_INLINE Real* own_rows() const { return block + front.in_block(column); }

  /// Subtracts the products of the columns to the left from some packs of rows, and divides the
  /// rows by the panel's triangle.
  template <int packs>
  IBMFAIR_INLINE void tile(Index first) const {
    const std::ptrdiff_t stride = front.stride();
    Real* const A = block + first * stride;
    const auto due = Tile<Real, packs>::product(A + pack * strip, stride, own_rows() + pack * strip,
                                                column - strip);
    for (int p = 0; p < packs; ++p) {
      Real* const a = A + p * stride + pack * column;
      Pack<Real> x[panel_width];
      for (int c = 0; c < panel_width; ++c) {
        x[c] = load<Pack<Real>>(a + pack * c) - due.sum[p][c];
      }
      divide(x);
      for (int c = 0; c < panel_width; ++c) {
        store(a + pack * c, x[c]);
      }
    }
  }

  /// Factors the panel's triangle and divides the other rows of its pack. Returns -1, or the index
  /// of the first of the `columns` columns whose pivot is not positive.
  IBMFAIR_INLINE Index factor(Index columns) const {
    Real* const A = own_rows() - column % pack;
    const auto due =
        Tile<Real, 1>::product(A + pack * strip, 0, own_rows() + pack * strip, column - strip);
    Pack<Real> x[panel_width];
    for (int c = 0; c < panel_width; ++c) {
      x[c] = load<Pack<Real>>(A + pack * (column + c)) - due.sum[0][c];
      store(A + pack * (column + c), x[c]);
    }
    Real* const L = own_rows() + pack * column;  // L_ij at L[i + pack * j]
    for (Index j = 0; j < panel_width; ++j) {
      for (Index k = 0; k < j; ++k) {
        for (Index i = j; i < panel_width; ++i) {
          L[i + pack * j] -= L[i + pack * k] * L[j + pack * k];
        }
      }
      const Real pivot = L[j + pack * j];
      if (j < columns && !(pivot > 0)) return j;
      inverse[j] = j < columns ? 1 / std::sqrt(pivot) : 0;
      for (Index i = j; i < panel_width; ++i) {
        L[i + pack * j] *= inverse[j];
      }
    }
    divide(x);
    for (int c = 0; c < panel_width; ++c) {
      store(A + pack * (column + c), x[c]);
    }
    return -1;
  }

 private:
  /// x L^-T for the row x of each lane.
  IBMFAIR_INLINE void divide(Pack<Real> (&x)[panel_width]) const {
    const Real* const L = own_rows() + pack * column;
    for (int j = 0; j < panel_width; ++j) {
      for (int k = 0; k < j; ++k) {
        x[j] -= x[k] * L[j + pack * k];
      }
      x[j] *= inverse[j];
    }
  }
};

/// Factors the columns first .. last - 1 of a block, in the packs that contain their own rows.
template <class Real>
struct FactorStrip {
  IBMFAIR_INLINE static Index run(FrontLayout<Real> front, Real* block, Index first, Index last,
                                  Real* inverse) {
    for (Index j = first; j < last; j += panel_width, inverse += panel_width) {
      const Panel<Real> panel{front, block, first, j, inverse};
      if (const Index bad = panel.factor(std::min(panel_width, last - j)); bad >= 0) {
        return j + bad;
      }
      in_tiles(j / pack_rows<Real> + 1, packs_of<Real>(last), panel);
    }
    return -1;
  }
};

/// Computes the columns first .. last - 1 in the packs below those of FactorStrip.
template <class Real>
struct DivideBand {
  FrontLayout<Real> front;
  Real* block;
  Index first, last;
  Real* inverse;

  template <int packs>
  IBMFAIR_INLINE void tile(Index p) const {
    for (Index j = first; j < last; j += panel_width) {
      const Panel<Real> panel{front, block, first, j, inverse + (j - first)};
      panel.template tile<packs>(p);
    }
  }

  IBMFAIR_INLINE static void run(const DivideBand& strip, Index first_pack, Index last_pack) {
    in_tiles(first_pack, last_pack, strip);
  }
};

/// Subtracts the products of a strip from columns to its right.
template <class Real>
struct SubtractBand {
  static constexpr Index pack = pack_rows<Real>;

  FrontLayout<Real> front;
  const Real* block;
  Index strip, width;
  FrontPart part;
  Real* numbers;      // the numbers of the part
  Index first, last;  // range of columns of the part
  Index column = 0;   // first column of the current panel

  template <int packs>
  IBMFAIR_INLINE void tile(Index p) const {
    const std::ptrdiff_t stride = front.stride();
    const bool is_new = part == FrontPart::update && strip == 0;
    const auto due =
        Tile<Real, packs>::product(block + p * stride + pack * strip, stride,
                                   block + front.in_block(column) + pack * strip, width);
    for (int i = 0; i < packs; ++i) {
      const Index row = pack * (p + i);
      Real* const to = numbers + pack * std::ptrdiff_t{column} + front.in(part, row);
      for (int c = 0; c < panel_width; ++c) {
        const auto sum = due.sum[i][c];
        store(to + pack * c, is_new ? -sum : load<Pack<Real>>(to + pack * c) - sum);
      }
    }
  }

  IBMFAIR_INLINE static void run(SubtractBand band, Index first_pack, Index last_pack) {
    const Index last = std::min(band.last, pack * last_pack);
    for (band.column = band.first; band.column < last; band.column += panel_width) {
      in_tiles(std::max(first_pack, band.column / pack), last_pack, band);
    }
  }
};

/// Calls Kernel::run(step, first, last) for bands that cover the packs first .. last - 1.
template <class Kernel>
void in_bands(const Kernel& step, Index first, Index last, double multiplications) {
  run_tasks((last - first + band_packs - 1) / band_packs, multiplications > worth_sharing_front,
            [&](std::int64_t band) {
              const FlushSubnormals flush;  // this task may run on another thread
              const Index begin = first + static_cast<Index>(band) * band_packs;
              run_kernel<Kernel>(step, begin, std::min(begin + band_packs, last));
            });
}

}  // namespace

template <class Real>
Index factor_front(const FrontLayout<Real>& front, Real* block, Real* update) {
  constexpr Index pack = pack_rows<Real>;
  const Index columns = front.columns, packs = front.packs();
  const Index strips = (columns + strip_width - 1) / strip_width;
  const Index even = (columns + strips - 1) / strips;
  const Index width = (even + panel_width - 1) / panel_width * panel_width;
  Real inverse[strip_width];
  for (Index first = 0; first < columns; first += width) {
    const Index last = std::min(first + width, columns);
    const Index bad = run_kernel<FactorStrip<Real>>(front, block, first, last, inverse);
    if (bad >= 0) {
      return bad;
    }
    const double rows = front.rows - last, products = rows * (last - first);
    in_bands(DivideBand<Real>{front, block, first, last, inverse}, packs_of<Real>(last), packs,
             products * (last - first) / 2);
    const auto subtract = [&](FrontPart part, Real* numbers, Index begin, Index end) {
      in_bands(SubtractBand<Real>{front, block, first, last - first, part, numbers, begin, end},
               begin / pack, packs, products * (end - begin));
    };
    if (last < columns) {
      subtract(FrontPart::block, block, last, columns);
    }
    if (columns < front.rows) {
      subtract(FrontPart::update, update, columns / panel_width * panel_width, pack * packs);
    }
  }
  return -1;
}

template Index factor_front(const FrontLayout<float>&, float*, float*);
template Index factor_front(const FrontLayout<double>&, double*, double*);

}  // namespace ibmfair
