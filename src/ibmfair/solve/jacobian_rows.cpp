#include "ibmfair/solve/jacobian_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr std::int64_t rows_per_task = 4096;

}  // namespace

JacobianRows::JacobianRows(const Rows& stencils, const Unknowns& unknowns)
    : stencils_(stencils),
      unknowns_(unknowns),
      places_(positions_by_value(stencils.value, static_cast<Index>(unknowns.unknown.size()))),
      stencil_of_place_(row_of_position(stencils)),
      a_(unknowns.size()),
      inverse_diagonal_(unknowns.size()) {
  find_columns();
}

void JacobianRows::find_columns() {
  std::vector<std::vector<Index>> parts((size() + rows_per_task - 1) / rows_per_task);
  columns_.first.resize(static_cast<std::size_t>(size()) + 1);
  const auto find = [&](std::int64_t first, std::int64_t last, std::vector<Index>& row_of) {
    std::vector<Index>& part = parts[first / rows_per_task];
    for (auto u = static_cast<Index>(first); u < last; ++u) {
      const std::size_t before = part.size();
      row_of[u] = u + 1;
      for (const Index place : places_[unknowns_.vertex[u]]) {
        for (const Index w : stencils_[stencil_of_place_[place]]) {
          const Index v = unknowns_.unknown[w];
          if (v >= 0 && row_of[v] != u + 1) {
            row_of[v] = u + 1;
            part.push_back(v);
          }
        }
      }
      columns_.first[u + 1] = static_cast<std::int64_t>(part.size() - before);
    }
  };
  parallel_parts(size(), rows_per_task, unknowns_.vertex.size(), find);
  std::partial_sum(columns_.first.begin(), columns_.first.end(), columns_.first.begin());
  columns_.value.resize(static_cast<std::size_t>(columns_.first.back()));
  b_.resize(columns_.value.size());
  parallel_for(static_cast<std::int64_t>(parts.size()), [&](std::int64_t p) {
    std::copy(parts[p].begin(), parts[p].end(),
              columns_.value.begin() + columns_.first[p * rows_per_task]);
  });
}

void JacobianRows::update_diagonal(const StencilWeights& weights, const Eigen::VectorXd& D,
                                   double h) {
  Eigen::VectorXd diagonal(size());
  parallel_for(size(), [&](std::int64_t u) {
    double S = 0;
    for (const Index place : places_[unknowns_.vertex[u]]) {
      S += weights.w[stencil_of_place_[place]] * weights.c[place] * weights.c[place];
    }
    diagonal[u] = D[u] + h * S;
  });
  for (Index u = 0; u < size(); ++u) {
    if (!(diagonal[u] > 0) || !std::isfinite(diagonal[u])) {
      throw FactorizationFailed(fmt::format(
          "the Jacobian is not positive definite at unknown {}: a triangle there has (almost) no "
          "area, or a coordinate is not finite",
          u));
    }
  }
  unit_ = diagonal.size() > 0 ? std::sqrt(diagonal.minCoeff()) * std::sqrt(diagonal.maxCoeff()) : 1;
  inverse_diagonal_ = (unit_ * diagonal.cwiseInverse()).cast<float>();
}

void JacobianRows::update(const StencilWeights& weights, const Eigen::VectorXd& D, double h) {
  update_diagonal(weights, D, h);
  // Two more sums than columns: for the vertex itself, which is not needed, and for what is held.
  // The inner loop has no branches.
  const auto fill = [&](std::int64_t first, std::int64_t last, std::vector<Index>& slot) {
    std::vector<double> sums;
    for (auto u = static_cast<Index>(first); u < last; ++u) {
      const auto columns = columns_[u];
      const auto own = static_cast<Index>(columns.size()), held = own + 1;
      for (Index k = 0; k < own; ++k) {
        slot[columns[k] + 1] = k;
      }
      slot[u + 1] = own;
      slot[0] = held;
      sums.assign(columns.size() + 2, 0);
      for (const Index place : places_[unknowns_.vertex[u]]) {
        const Index s = stencil_of_place_[place];
        const double factor = h / unit_ * weights.w[s] * weights.c[place];
        for (std::int64_t k = stencils_.first[s]; k < stencils_.first[s + 1]; ++k) {
          sums[slot[unknowns_.unknown[stencils_.value[k]] + 1]] += factor * weights.c[k];
        }
      }
      a_[u] = static_cast<float>(D[u] / unit_ - sums[held]);
      std::transform(sums.begin(), sums.begin() + own, b_.begin() + columns_.first[u],
                     [](double sum) { return static_cast<float>(sum); });
    }
  };
  parallel_parts(size(), rows_per_task, unknowns_.vertex.size() + 1, fill);
}

double JacobianRows::apply(const Quads& p, Quads& q) const {
  return parallel_sum(size(), [&](std::int64_t u) {
    const Eigen::Array4f own = p.col(u);
    Eigen::Array4f sum = a_[u] * own;
    for (std::int64_t k = columns_.first[u]; k < columns_.first[u + 1]; ++k) {
      sum += b_[k] * (p.col(columns_.value[k]) - own);
    }
    q.col(u) = sum;
    return static_cast<double>((own * sum).sum());
  });
}

}  // namespace ibmfair
