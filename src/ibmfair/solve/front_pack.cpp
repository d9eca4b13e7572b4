#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/front_kernels.h"

namespace ibmfair {
namespace {

/// Numbers of a front.
constexpr std::int64_t worth_sharing_packing = 1'000'000;

/// The first `rows` rows of a chunk's columns, inverted as front_kernels.h has it. `L` has its
/// columns `stride` apart.
template <class Real>
void invert_chunk(const Real* L, Index stride, Index rows, Index columns, Real* inverse) {
  constexpr Index pack = pack_rows<Real>;
  std::fill_n(inverse, pack * columns, Real(0));
  const auto entry = [&](Index i, Index j) { return L[i + std::int64_t{stride} * j]; };
  for (Index k = 0; k < columns; ++k) {
    Real* const column = inverse + pack * k;
    column[k] = 1 / entry(k, k);
    for (Index i = k + 1; i < rows; ++i) {
      Real sum = 0;
      for (Index j = k; j < std::min(i, columns); ++j) {
        sum += entry(i, j) * column[j];
      }
      column[i] = i < columns ? -sum / entry(i, i) : -sum;
    }
    column[k] -= 1;
  }
}

/// Rows first .. rows - 1 of a panel, pack by pack. Returns the end of what was written.
template <class Real>
Real* pack_panel(const Real* L, Index stride, Index first, Index rows, Index columns, Real* to) {
  constexpr Index pack = pack_rows<Real>;
  for (Index i = first; i < rows; i += pack) {
    const Index count = std::min(pack, rows - i);
    for (Index k = 0; k < columns; ++k, to += pack) {
      std::copy_n(L + i + std::int64_t{stride} * k, count, to);
      std::fill_n(to + count, pack - count, Real(0));
    }
  }
  return to;
}

}  // namespace

template <class Real>
void pack_front(const Real* block, Index rows, Index columns, Real* packed) {
  constexpr Index pack = pack_rows<Real>;
  const auto pack_chunk = [&](std::int64_t chunk) {
    const Index first = static_cast<Index>(chunk) * pack, width = std::min(pack, columns - first);
    const Real* L = block + first * (std::int64_t{rows} + 1);
    Real* to = packed + packed_size<Real>(rows, first);
    invert_chunk(L, rows, std::min(pack, rows - first), width, to);
    to += pack * width;
    for (Index k = 0; k < width; k += panel_width, L += std::int64_t{panel_width} * rows) {
      to = pack_panel(L, rows, pack, rows - first, std::min(panel_width, width - k), to);
    }
  };
  run_tasks(packs_of<Real>(columns), packed_size<Real>(rows, columns) >= worth_sharing_packing,
            pack_chunk);
}

template void pack_front(const float*, Index, Index, float*);
template void pack_front(const double*, Index, Index, double*);

}  // namespace ibmfair
