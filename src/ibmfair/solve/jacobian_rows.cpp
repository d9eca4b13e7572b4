#include "ibmfair/solve/jacobian_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/conjugate_gradients_kernels.h"

namespace ibmfair {
namespace {

constexpr std::int64_t rows_per_task = 4096;

}  // namespace

JacobianRows::JacobianRows(const StencilTerms& terms, const Unknowns& unknowns)
    : terms_(terms),
      unknowns_(unknowns),
      beside_held_(unknowns.vertex.size(), 0),
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
      terms_.for_vertices(unknowns_.vertex[u], [&](Index w) {
        const Index v = unknowns_.unknown[w];
        if (v < 0) {
          beside_held_[u] = 1;
        } else if (row_of[v] != u + 1) {
          row_of[v] = u + 1;
          part.push_back(v);
        }
      });
      if ((part.size() - before) % 2 != 0) {
        part.push_back(u);  // its difference to itself is zero: kernels take two at a time
      }
      columns_.first[u + 1] = static_cast<std::int64_t>(part.size() - before);
    }
  };
  parallel_parts<Index>(size(), rows_per_task, unknowns_.vertex.size(), find);
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
    diagonal[u] = D[u] + h * terms_.diagonal(unknowns_.vertex[u], weights);
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
  // Terms are added up by vertex, in a loop without branches; only the sums of the row's columns
  // are set to zero before and read afterwards, and those of the held vertices beside it.
  const double scale = h / unit_;
  const auto fill = [&](std::int64_t first, std::int64_t last, std::vector<double>& sum) {
    for (auto u = static_cast<Index>(first); u < last; ++u) {
      const Index own = unknowns_.vertex[u];
      const auto columns = columns_[u];
      for (const Index v : columns) {
        sum[unknowns_.vertex[v]] = 0;
      }
      if (beside_held_[u] != 0) {
        take_held(own, sum);
      }
      terms_.for_terms(own, weights, [&](Index w, double term) { sum[w] += term; });
      std::transform(columns.begin(), columns.end(), b_.begin() + columns_.first[u],
                     [&](Index v) { return static_cast<float>(scale * sum[unknowns_.vertex[v]]); });
      const double held = beside_held_[u] != 0 ? take_held(own, sum) : 0;
      a_[u] = static_cast<float>(D[u] / unit_ - scale * held);
    }
  };
  parallel_parts<double>(size(), rows_per_task, terms_.vertex_count(), fill);
}

/// The sum over the held vertices beside vertex `own`, which are set to zero.
double JacobianRows::take_held(Index own, std::vector<double>& sum) const {
  double held = 0;
  terms_.for_vertices(own, [&](Index w) {
    if (unknowns_.unknown[w] < 0) {
      held += std::exchange(sum[w], 0.0);
    }
  });
  return held;
}

double JacobianRows::apply(const Quads& p, Quads& q) const {
  const DifferenceRows rows{columns_.first.data(), columns_.value.data(), b_.data(), a_.data()};
  return parallel_block_sum(size(), 0.0, [&](std::int64_t first, std::int64_t last) {
    return multiply_rows(rows, p.data(), q.data(), {first, last});
  });
}

}  // namespace ibmfair
