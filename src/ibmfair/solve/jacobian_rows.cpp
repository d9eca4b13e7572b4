#include "ibmfair/solve/jacobian_rows.h"

#include <cmath>
#include <span>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/select.h"
#include "ibmfair/solve/conjugate_gradients_kernels.h"

namespace ibmfair {
namespace {

/// The largest deviation of the unit from the middle of the diagonal, as a power of two; float32
/// allows 126.
constexpr double farthest_unit = 40;

/// The power of two next to the geometric mean of the smallest and the largest entry.
double middle_of(const Eigen::VectorXd& diagonal) {
  return diagonal.size() > 0
             ? std::exp2(std::round(
                   (std::log2(diagonal.minCoeff()) + std::log2(diagonal.maxCoeff())) / 2))
             : 1;
}

}  // namespace

JacobianRows::JacobianRows(const StencilTerms& terms, const Unknowns& unknowns)
    : sums_(terms, unknowns, RowSums::Others::all_in_pairs), inverse_diagonal_(unknowns.size()) {
  for (const RowBlock& block : sums_.blocks()) {
    b_.emplace_back(block.first.back());
  }
}

std::int64_t JacobianRows::entries() const {
  std::int64_t sum = -size();
  for (const RowBlock& block : sums_.blocks()) {
    sum += block.first.back();
  }
  return sum;
}

void JacobianRows::update(const StencilWeights& weights, const Eigen::VectorXd& D, double h) {
  diagonal_.resize(size());
  fill(weights, D, h);
  const std::vector<Index> wrong = indices_where(
      size(), [&](Index u) { return !(diagonal_[u] > 0) || !std::isfinite(diagonal_[u]); });
  if (!wrong.empty()) {
    throw FactorizationFailed(fmt::format(
        "the Jacobian is not positive definite at unknown {}: a triangle there has (almost) no "
        "area, or a coordinate is not finite",
        wrong.front()));
  }
  const double unit = middle_of(diagonal_);
  if (std::abs(std::log2(unit / unit_)) > farthest_unit) {
    unit_ = unit;
    fill(weights, D, h);
  }
  parallel_for(size(), [&](std::int64_t u) {
    inverse_diagonal_[u] = static_cast<float>(unit_ / diagonal_[u]);
  });
}

void JacobianRows::fill(const StencilWeights& weights, const Eigen::VectorXd& D, double h) {
  const double scale = h / unit_;
  sums_.for_rows(weights, [&](Index u, std::span<const double> entries, double fixed) {
    diagonal_[u] = D[u] + h * entries[0];
    const RowBlock& block = sums_.blocks()[u / RowSums::block_size];
    float* b = &b_[u / RowSums::block_size][block.first[u % RowSums::block_size]];
    b[0] = static_cast<float>(D[u] / unit_ - scale * fixed);
    for (std::size_t k = 1; k < entries.size(); ++k) {
      b[k] = static_cast<float>(scale * entries[k]);
    }
  });
}

double JacobianRows::apply(const Quads& p, Quads& q) const {
  return parallel_block_sum(size(), 0.0, [&](std::int64_t begin, std::int64_t end) {
    const std::int64_t b = begin / RowSums::block_size;
    const RowBlock& block = sums_.blocks()[b];
    const DifferenceRows rows{&block.first[begin % RowSums::block_size], block.column.data(),
                              b_[b].data()};
    return multiply_rows(rows, p.data(), q.data(), {begin, end});
  });
}

}  // namespace ibmfair
