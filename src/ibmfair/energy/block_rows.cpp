#include "ibmfair/energy/block_rows.h"

#include <cstddef>
#include <cstring>

#include "ibmfair/base/lanes.h"

namespace ibmfair {
namespace {

struct LoadRows {
  IBMFAIR_INLINE static void run(const Index* v, std::size_t count, const double* X,
                                 BlockVertex* to) {
    for (const Index* end = v + count; v != end; ++v, ++to) {
      store(&to->x.x, three_numbers(X + 3 * std::ptrdiff_t{*v}));
      store(&to->sum.x, Lanes{});
    }
  }
};

}  // namespace

void load_rows(std::span<const Index> v, const Points& X, BlockVertex* to) {
  run_kernel<LoadRows>(v.data(), v.size(), X.data(), to);
}

void store_sums(std::span<const Index> v, const BlockVertex* from, Points& G) {
  double* rows = G.data();
  for (const Index row : v) {
    std::memcpy(rows + 3 * std::ptrdiff_t{row}, &from->sum.x, 3 * sizeof(double));
    ++from;
  }
}

}  // namespace ibmfair
