#include "ibmfair/energy/hessian.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr std::int64_t columns_per_task = 4096;

}  // namespace

Points multiply(const SymmetricMatrix& J, const Points& X) {
  Points Y = Points::Zero(X.rows(), 3);
  for (std::int64_t j = 0; j < J.size(); ++j) {
    const std::int64_t diagonal = J.column_first[j];
    Y.row(j) += J.value[diagonal] * X.row(j);
    for (std::int64_t k = diagonal + 1; k < J.column_first[j + 1]; ++k) {
      Y.row(J.row[k]) += J.value[k] * X.row(j);
      Y.row(j) += J.value[k] * X.row(J.row[k]);
    }
  }
  return Y;
}

Unknowns::Unknowns(const std::vector<std::uint8_t>& fixed, const std::vector<std::uint8_t>& own)
    : unknown(fixed.size(), -1) {
  Index next = 0;
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if (!fixed[v]) {
      unknown[v] = next++;
      if (own.empty() || own[v]) {
        vertex.push_back(static_cast<Index>(v));
      }
    }
  }
}

HessianAssembler::HessianAssembler(const Rows& stencils, const Unknowns& unknowns)
    : stencils_(stencils),
      unknowns_(unknowns),
      places_(positions_by_value(stencils.value, static_cast<Index>(unknowns.unknown.size()))),
      stencil_of_place_(row_of_position(stencils)) {
  std::vector<Index> rows;
  for (Index j = 0; j < unknowns_.size(); ++j) {
    rows.assign(1, j);
    for (const Index place : places_[unknowns_.vertex[j]]) {
      for (const Index v : stencils_[stencil_of_place_[place]]) {
        if (unknowns_.unknown[v] > j) {
          rows.push_back(unknowns_.unknown[v]);
        }
      }
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    pattern_.row.insert(pattern_.row.end(), rows.begin(), rows.end());
    pattern_.column_first.push_back(static_cast<std::int64_t>(pattern_.row.size()));
  }
  pattern_.value.assign(pattern_.row.size(), 0);
}

void HessianAssembler::assemble(const StencilWeights& weights, SymmetricMatrix& S) const {
  // Column by column, each gathered from the stencils at its vertex: nothing is stored per term,
  // and no two threads write the same entry.
  const auto fill = [&](std::int64_t first, std::int64_t last,
                        std::vector<Index>& place_in_column) {
    for (std::int64_t j = first; j < last; ++j) {
      double* column = &S.value[S.column_first[j]];
      const std::int64_t size = S.column_first[j + 1] - S.column_first[j];
      for (std::int64_t k = 0; k < size; ++k) {
        place_in_column[S.row[S.column_first[j] + k]] = static_cast<Index>(k);
      }
      std::fill(column, column + size, 0.0);
      for (const Index place : places_[unknowns_.vertex[j]]) {
        const Index s = stencil_of_place_[place];
        const double wc = weights.w[s] * weights.c[place];
        for (std::int64_t other = stencils_.first[s]; other < stencils_.first[s + 1]; ++other) {
          if (const Index i = unknowns_.unknown[stencils_.value[other]]; i >= j) {
            column[place_in_column[i]] += wc * weights.c[other];
          }
        }
      }
    }
  };
  parallel_parts(S.size(), columns_per_task, unknowns_.vertex.size(), fill);
}

}  // namespace ibmfair
