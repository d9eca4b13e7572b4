#include "ibmfair/energy/hessian.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "ibmfair/base/parallel.h"

namespace ibmfair {

HessianAssembler::HessianAssembler(const StencilTerms& terms, const Unknowns& unknowns)
    : sums_(terms, unknowns, RowSums::Others::later) {}

SymmetricMatrix HessianAssembler::pattern() const {
  SymmetricMatrix S;
  S.column_first.reserve(static_cast<std::size_t>(sums_.size()) + 1);
  for (const RowBlock& block : sums_.blocks()) {
    const std::int64_t before = S.column_first.back();
    std::transform(block.first.begin() + 1, block.first.end(), std::back_inserter(S.column_first),
                   [&](std::int64_t end) { return before + end; });
  }
  S.row.resize(static_cast<std::size_t>(S.column_first.back()));
  const auto copy = [&](std::int64_t b) {
    const RowBlock& block = sums_.blocks()[b];
    std::copy(block.column.begin(), block.column.end(),
              S.row.begin() + S.column_first[b * RowSums::block_size]);
  };
  run_tasks(static_cast<std::int64_t>(sums_.blocks().size()), sums_.size() >= worth_sharing, copy);
  S.value.resize(S.row.size());
  return S;
}

void HessianAssembler::assemble(const StencilWeights& weights, SymmetricMatrix& S) const {
  sums_.for_rows(weights, [&](Index j, std::span<const double> entries, double /*rest*/) {
    std::copy(entries.begin(), entries.end(), S.value.begin() + S.column_first[j]);
  });
}

}  // namespace ibmfair
