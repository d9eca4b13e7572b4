#include <algorithm>
#include <utility>

#include "ibmfair/solve/front_packs.h"

namespace ibmfair {
namespace {

/// The factor is prefetched this many bytes ahead: small fronts end before the hardware prefetcher
/// starts.
constexpr std::ptrdiff_t ahead = 8192;

/// The cache level for these prefetches. A substitution reads every number of the factor once, and
/// there are many of them. If they bypass the larger caches, they do not evict the vectors from
/// them. This is faster on AMD's processors; on Intel's, this way is so narrow that a substitution
/// takes twice as long.
enum class FetchTo : std::uint8_t { first_cache_only, second_cache };

FetchTo best_fetch() {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_is("amd") ? FetchTo::first_cache_only : FetchTo::second_cache;
#else
  return FetchTo::second_cache;
#endif
}

constexpr std::ptrdiff_t cache_line = 64;

/// Prefetches the `count` numbers at `distance` bytes after `numbers`.
template <FetchTo place, std::ptrdiff_t count, class Real>
IBMFAIR_INLINE void fetch(const Real* numbers, std::ptrdiff_t distance) {
  const char* const bytes = reinterpret_cast<const char*>(numbers) + distance;
  for (std::ptrdiff_t i = 0; i < count * std::ptrdiff_t{sizeof(Real)}; i += cache_line) {
    __builtin_prefetch(bytes + i, 0, place == FetchTo::first_cache_only ? 0 : 2);  // 0: for reading
  }
}

/// The workspace from pack p on.
template <class Real>
IBMFAIR_INLINE Real* from_pack(Real* W, Index p) {
  return W + std::ptrdiff_t{3} * pack_rows<Real> * p;
}

/// Three consecutive packs in a workspace, one per coordinate.
template <class Real>
IBMFAIR_INLINE Pack3<Real> load_three(const Real* W) {
  constexpr Index pack = pack_rows<Real>;
  return {load<Pack<Real>>(W), load<Pack<Real>>(W + pack), load<Pack<Real>>(W + 2 * pack)};
}
template <class Real>
IBMFAIR_INLINE void store_three(Real* W, const Pack3<Real>& three) {
  for (int c = 0; c < 3; ++c) {
    store(W + c * pack_rows<Real>, three.c[c]);
  }
}

/// Substitution with one panel: `L` has the panel's packs below the chunk, and W the rows of the
/// vectors beside these packs.
template <class Real, int width, FetchTo place>
struct Panel {
  static constexpr Index pack = pack_rows<Real>;

  /// W -= L x, where x has the rows of the panel's own columns. Returns the end of the panel.
  IBMFAIR_INLINE static const Real* forward(const Real* L, Index packs, const Real* x, Real* W) {
    Real factor[3][width];
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < width; ++k) {
        factor[c][k] = x[c * pack + k];
      }
    }
    for (; packs > 0; --packs, L += width * pack, W += 3 * pack) {
      fetch<place, width * pack>(L, ahead);
      for (int c = 0; c < 3; ++c) {
        Pack<Real> sum = factor[c][0] * load<Pack<Real>>(L);
        for (int k = 1; k < width; ++k) {
          sum += factor[c][k] * load<Pack<Real>>(L + k * pack);
        }
        store(W + c * pack, load<Pack<Real>>(W + c * pack) - sum);
      }
    }
    return L;
  }

  /// sum = L^T W, coordinate by coordinate. Starts at the ends of the panel and of W, and returns
  /// the start of the panel.
  IBMFAIR_INLINE static const Real* backward(const Real* L, Index packs, const Real* W,
                                             Row4<Real> (&sum)[3]) {
    Pack<Real> of_column[3][panel_width] = {};
    for (; packs > 0; --packs) {
      L -= width * pack;
      W -= 3 * pack;
      fetch<place, width * pack>(L, -ahead);
      for (int k = 0; k < width; ++k) {
        for (int c = 0; c < 3; ++c) {
          of_column[c][k] += load<Pack<Real>>(L + k * pack) * load<Pack<Real>>(W + c * pack);
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      sum[c] = sums(of_column[c][0], of_column[c][1], of_column[c][2], of_column[c][3]);
    }
    return L;
  }
};

/// The results of a chunk's panels side by side.
IBMFAIR_INLINE Pack<float> beside(const Row4<float> (&of_panel)[2][3], int c) {
  return both_halves(of_panel[0][c], of_panel[1][c]);
}
IBMFAIR_INLINE Pack<double> beside(const Row4<double> (&of_panel)[1][3], int c) {
  return of_panel[0][c];
}

/// Substitution with one chunk; W starts at the chunk's own pack.
template <class Real, int columns, FetchTo place>
struct Chunk {
  static constexpr Index pack = pack_rows<Real>;
  static constexpr int first_width = std::min<int>(columns, panel_width);
  static constexpr int second_width = columns - first_width;
  using Panels = Row4<Real>[pack / panel_width][3];

  IBMFAIR_INLINE static const Real* forward(const Real* L, Index packs, Real* W) {
    Pack3<Real> own = load_three(W);
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      Pack<Real> sum = W[c * pack] * load<Pack<Real>>(L);
      for (int k = 1; k < columns; ++k) {
        sum += W[c * pack + k] * load<Pack<Real>>(L + k * pack);
      }
      own.c[c] += sum;
    }
    store_three(W, own);
    L += columns * pack;
    L = Panel<Real, first_width, place>::forward(L, packs - 1, W, W + 3 * pack);
    if constexpr (second_width > 0) {
      L = Panel<Real, second_width, place>::forward(L, packs - 1, W + panel_width, W + 3 * pack);
    }
    return L;
  }

  IBMFAIR_INLINE static const Real* backward(const Real* L, Index packs, Real* W) {
    const Real* const end = from_pack(W, packs);
    Panels sum = {};
    if constexpr (second_width > 0) {
      L = Panel<Real, second_width, place>::backward(L, packs - 1, end, sum[1]);
    }
    L = Panel<Real, first_width, place>::backward(L, packs - 1, end, sum[0]);
    Pack3<Real> own = load_three(W);
    for (int c = 0; c < 3; ++c) {
      own.c[c] -= beside(sum, c);
    }
    L -= columns * pack;
    add_transposed(L, own);
    store_three(W, own);
    return L;
  }

 private:
  /// `own` becomes (I + T)^T own, where T is stored at the start of the chunk.
  IBMFAIR_INLINE static void add_transposed(const Real* T, Pack3<Real>& own) {
    Panels sum = {};
    for (int c = 0; c < 3; ++c) {
      for (int first = 0; first < columns; first += panel_width) {
        Pack<Real> of_column[panel_width] = {};
        for (int k = 0; k < std::min<int>(panel_width, columns - first); ++k) {
          of_column[k] = load<Pack<Real>>(T + (first + k) * pack) * own.c[c];
        }
        sum[first / panel_width][c] = sums(of_column[0], of_column[1], of_column[2], of_column[3]);
      }
      own.c[c] += beside(sum, c);
    }
  }
};

/// The widths of chunks, minus one.
template <class Real>
using Widths = std::make_integer_sequence<int, pack_rows<Real>>;

/// Fills the workspace with `rows` rows.
template <class Real, class CompressedRows>
IBMFAIR_INLINE void gather(const CompressedRows& source, Index rows, Real* W) {
  constexpr Index pack = pack_rows<Real>;
  Index first = 0;
  for (; first + pack <= rows; first += pack, W += 3 * pack) {
    CompressedRows whole = source;
    whole.count = first + pack;
    store_three(W, to_packs(whole, first, Real()));
  }
  if (first < rows) {
    store_three(W, to_packs(source, first, Real()));
  }
}

/// Rows first .. last - 1 of the workspace as rows of four numbers each.
template <class Real>
IBMFAIR_INLINE void scatter(const Real* W, Index first, Index last, Real* to) {
  constexpr Index pack = pack_rows<Real>;
  for (Index begin = first / pack * pack; begin < last; begin += pack) {
    const Pack3<Real> three = load_three(W + 3 * std::ptrdiff_t{begin});
    if (begin >= first && begin + pack <= last) {
      to_rows(three, to + 4 * std::ptrdiff_t{begin - first});
    } else {
      Real some[4 * pack];
      to_rows(three, some);
      for (Index i = std::max(begin, first); i < std::min(begin + pack, last); ++i) {
        store(to + 4 * std::ptrdiff_t{i - first}, load<Row4<Real>>(some + 4 * (i - begin)));
      }
    }
  }
}

template <class Real, FetchTo place>
struct Forward {
  IBMFAIR_INLINE static void run(const Real* L, Index rows, Index columns, const Real* front,
                                 Real* own, Real* below, Real* W) {
    constexpr Index pack = pack_rows<Real>;
    gather(RowsInTurn<Real>{front, rows}, rows, W);
    const Index packs = packs_of<Real>(rows), whole = columns / pack;
    for (Index p = 0; p < whole; ++p) {
      L = Chunk<Real, pack, place>::forward(L, packs - p, from_pack(W, p));
    }
    last_chunk(columns - pack * whole, L, packs - whole, from_pack(W, whole), Widths<Real>{});
    scatter(W, 0, columns, own);
    scatter(W, columns, rows, below);
  }

 private:
  template <int... less_one>
  IBMFAIR_INLINE static void last_chunk(Index columns, const Real* L, Index packs, Real* W,
                                        std::integer_sequence<int, less_one...> /*widths*/) {
    ((columns == less_one + 1 ? void(Chunk<Real, less_one + 1, place>::forward(L, packs, W))
                              : void()),
     ...);
  }
};

template <class Real, FetchTo place>
struct Backward {
  IBMFAIR_INLINE static void run(const Real* L, Index rows, Index columns, const Index* row,
                                 Real* x, Real* W) {
    constexpr Index pack = pack_rows<Real>;
    gather(NamedRows<Real>{x, row, rows}, rows, W);
    L += packed_size<Real>(rows, columns);
    const Index packs = packs_of<Real>(rows);
    Index p = columns / pack;
    L = last_chunk(columns - pack * p, L, packs - p, from_pack(W, p), Widths<Real>{});
    while (p > 0) {
      --p;
      L = Chunk<Real, pack, place>::backward(L, packs - p, from_pack(W, p));
    }
    scatter(W, 0, columns, x + 4 * std::ptrdiff_t{row[0]});
  }

 private:
  template <int... less_one>
  IBMFAIR_INLINE static const Real* last_chunk(Index columns, const Real* L, Index packs, Real* W,
                                               std::integer_sequence<int, less_one...> /*widths*/) {
    ((L = columns == less_one + 1 ? Chunk<Real, less_one + 1, place>::backward(L, packs, W) : L),
     ...);
    return L;
  }
};

/// Calls Kernel<Real, place>::run(arguments...) with the best `place` for this processor.
template <template <class, FetchTo> class Kernel, class Real, class... Arguments>
void run_fetching(Arguments... arguments) {
  static const FetchTo best = best_fetch();
  if (best == FetchTo::first_cache_only) {
    run_kernel<Kernel<Real, FetchTo::first_cache_only>>(arguments...);
  } else {
    run_kernel<Kernel<Real, FetchTo::second_cache>>(arguments...);
  }
}

}  // namespace

template <class Real>
void substitute_forward(const Real* packed, Index rows, Index columns, const Real* front, Real* own,
                        Real* below, Real* workspace) {
  run_fetching<Forward, Real>(packed, rows, columns, front, own, below, workspace);
}

template <class Real>
void substitute_backward(const Real* packed, Index rows, Index columns, const Index* row, Real* x,
                         Real* workspace) {
  run_fetching<Backward, Real>(packed, rows, columns, row, x, workspace);
}

template void substitute_forward(const float*, Index, Index, const float*, float*, float*, float*);
template void substitute_forward(const double*, Index, Index, const double*, double*, double*,
                                 double*);
template void substitute_backward(const float*, Index, Index, const Index*, float*, float*);
template void substitute_backward(const double*, Index, Index, const Index*, double*, double*);

}  // namespace ibmfair
