#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/front_kernels.h"

namespace ibmfair {
namespace {

/// The number of values of a front from which on packing is shared among threads.
constexpr std::int64_t worth_sharing_packing = 1'000'000;

/// Inverts the diagonal pack of a chunk, which has `rows` rows, as described in front_kernels.h.
template <class Real>
void invert_chunk(const Real* L, Index rows, Index columns, Real* inverse) {
  constexpr Index pack = pack_rows<Real>;
  std::fill_n(inverse, pack * columns, Real(0));
  const auto entry = [&](Index i, Index j) { return L[i + pack * j]; };
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

}  // namespace

template <class Real>
void pack_front(const FrontLayout<Real>& front, const Real* block, Real* packed) {
  constexpr Index pack = pack_rows<Real>;
  const Index rows = front.rows, columns = front.columns;
  const auto pack_chunk = [&](std::int64_t chunk) {
    const Index first = static_cast<Index>(chunk) * pack, width = std::min(pack, columns - first);
    const Real* L = block + front.in_block(first) + std::ptrdiff_t{pack} * first;
    Real* to = packed + packed_size<Real>(rows, first);
    invert_chunk(L, std::min(pack, rows - first), width, to);
    to += pack * width;
    for (Index k = 0; k < width; k += panel_width) {
      const Index count = pack * std::min(panel_width, width - k);
      for (std::ptrdiff_t p = 1; p < front.packs() - chunk; ++p, to += count) {
        std::copy_n(L + p * front.stride() + pack * k, count, to);
      }
    }
  };
  run_tasks(packs_of<Real>(columns), packed_size<Real>(rows, columns) >= worth_sharing_packing,
            pack_chunk);
}

template void pack_front(const FrontLayout<float>&, const float*, float*);
template void pack_front(const FrontLayout<double>&, const double*, double*);

}  // namespace ibmfair
