#include "ibmfair/flow/linear_system/iterative_jacobian.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ibmfair/base/quantile.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// The number of iterations of solves that start along the previous step, relative to solves from
/// zero. The first steps differ from each other and gain nothing.
double share_of_iterations(int steps) {
  const double along = tuning.solver.along;
  return along + (1 - along) * std::min(1.0, tuning.solver.unlike_steps / std::max(1, steps));
}

}  // namespace

int most_iterations(double tolerance) {
  const double digits = std::log(tolerance) / std::log(FlowOptions().solver_tolerance);
  return static_cast<int>(tuning.solver.most_iterations * std::max(1.0, digits));
}

/// The number of iterations is proportional to the square root of the condition number, which
/// depends on the large values of diag(J) / D. The largest values belong to needles, which a noisy
/// mesh has in the first steps only; so the median is used. If triangles vary in size, the small
/// values count as well: the median is then far above the lower decile, which noise does not
/// change. Needles thinner than noise makes them, as some scans have, cost iterations in addition,
/// for any cut-off. A sample of the unknowns is enough for the estimate.
IterationForecast forecast_iterations(const JacobianShape& shape, const JacobianParts& parts) {
  const SolverTuning& fit = tuning.solver;
  const Index stride = 1 + shape.unknowns.size() / fit.sampled_unknowns;
  std::vector<double> ratio;  // h diag(S) / D
  for (Index u = 0; u < shape.unknowns.size(); u += stride) {
    const double S = shape.terms.diagonal(shape.unknowns.vertex[u], parts.weights);
    if (S > 0) {  // S = 0 at isolated triangles, which need no iterations
      ratio.push_back(parts.h * S / parts.D[u]);
    }
  }
  const auto smallest = [&](double share) { return ratio.empty() ? 0 : quantile(ratio, share); };
  const double middle = smallest(0.5), needles = smallest(0.999) / (fit.by_noise * middle);
  return {.of_cutoff = fit.iterations * (1 + middle) / std::sqrt(1 + smallest(0.1)),
          .of_needles = needles > 1 ? fit.per_needle_digit * std::log10(needles) : 0};
}

SolverForecast forecast_iterative(const JacobianShape& shape, const IterationForecast& iterations) {
  const auto places = static_cast<double>(shape.terms.vertices_in_stencils());
  const int steps = shape.solves_left();
  return {.seconds = tuning.solver.row * shape.unknowns.size() * iterations.all() * steps *
                     share_of_iterations(steps),
          .bytes = tuning.solver.bytes_per_place * places +
                   tuning.solver.bytes_per_row * shape.unknowns.size()};
}

IterativeJacobian::IterativeJacobian(const JacobianShape& shape)
    : shape_(shape),
      J_(shape.terms, shape.unknowns),
      solver_(J_),
      tolerance_(shape.options.solver_tolerance) {}

void IterativeJacobian::update(const JacobianParts& parts) {
  const Stopwatch watch(shape_.report.seconds.assemble);
  J_.update(parts.weights, parts.D, parts.h);
}

void IterativeJacobian::solve(const Points& B, Points& Y) {
  double seconds = std::numeric_limits<double>::infinity();
  solve_within(seconds, B, Y);
}

bool IterativeJacobian::solve_within(double& seconds, const Points& B, Points& Y) {
  const Stopwatch watch(shape_.report.seconds.solve);
  const int most = most_iterations(tolerance_);
  const double each = tuning.solver.row * shape_.unknowns.size();
  const double paid = std::ceil(seconds / each);
  const int iterations =
      solver_.solve(B, Y, tolerance_, static_cast<int>(std::min<double>(paid, most)));
  shape_.report.iterations += iterations;
  seconds -= iterations * each;
  return paid >= most || iterations < paid;
}

void IterativeJacobian::tighten(double tolerance) {
  tolerance_ = std::min(tolerance_, tolerance);
}

}  // namespace ibmfair
