#include "ibmfair/flow/steps/curvature_pairs.h"

#include <vector>

#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// Cosine between step and change: below, rounding decides. No tuned constant.
constexpr double least_curvature = 1e-12;

double dot(const Points& a, const Points& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace

void CurvaturePairs::add(const Points& step, const Points& gradient_change) {
  const double curvature = dot(step, gradient_change);
  if (!(curvature > least_curvature * step.norm() * gradient_change.norm())) {
    return;
  }
  if (pairs_.size() == tuning.stationary.pairs) {
    pairs_.pop_front();
  }
  pairs_.push_back({step, gradient_change, curvature});
}

Points CurvaturePairs::direction(const Points& gradient,
                                 const std::function<Points(const Points&)>& solve) const {
  Points q = -gradient;
  std::vector<double> weight(pairs_.size());
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    weight[i] = dot(pairs_[i].step, q) / pairs_[i].curvature;
    q -= weight[i] * pairs_[i].change;
  }
  Points d = solve(q);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    d += (weight[i] - dot(pairs_[i].change, d) / pairs_[i].curvature) * pairs_[i].step;
  }
  return d;
}

}  // namespace ibmfair
