#include "ibmfair/flow/steps/step_model.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"

namespace ibmfair {

StepModel::StepModel(FlowProblem& problem, const Points& step) : energy_(problem.energy()) {
  const Points& g = problem.gradient();
  const Eigen::VectorXd& D = problem.jacobian().metric();
  const auto share = [&](std::int64_t u) -> Eigen::Array2d {
    return {-g.row(u).dot(step.row(u)), D[u] * step.row(u).squaredNorm()};
  };
  const Eigen::Array2d sums =
      parallel_sum(step.rows(), Eigen::Array2d(Eigen::Array2d::Zero()), share);
  slope_ = problem.parts.sum(sums[0]);
  metric_part_ = problem.parts.sum(sums[1]) / problem.jacobian().time_step();
}

double StepModel::decrease(double a) const {
  return std::min((a - a * a / 2) * slope_ + a * a / 2 * metric_part_, energy_);
}

}  // namespace ibmfair
