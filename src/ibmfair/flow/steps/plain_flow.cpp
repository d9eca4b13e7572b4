#include "ibmfair/flow/steps/plain_flow.h"

#include <cmath>

namespace ibmfair {

void run_plain(FlowProblem& problem, const StepObserver& observer) {
  FlowReport& report = problem.report;
  problem.jacobian().refactor(problem.X, problem.options.total_time / problem.options.steps);
  for (int k = 1; k <= problem.options.steps; ++k) {
    const std::optional<StepRecord> record = plain_step(problem);
    if (!record) {
      report.status = FlowStatus::diverged;
      return;
    }
    if (observer && !observer(*record)) {
      report.status = FlowStatus::interrupted;
      return;
    }
  }
}

std::optional<StepRecord> plain_step(FlowProblem& problem) {
  FlowReport& report = problem.report;
  const double h = problem.jacobian().time_step();
  Points step, Y;
  problem.update_gradient();
  problem.newton_step(step);
  const bool lands = problem.displace(step, Y) != FlowProblem::Landing::infeasible;
  const double energy = problem.energy_at(Y);
  if (!lands || !std::isfinite(energy) || problem.parts.any(!Y.allFinite())) {
    return std::nullopt;
  }
  problem.move_to(Y);
  StepRecord record;
  record.step = static_cast<int>(report.steps.size()) + 1;
  record.time = record.step * h;
  record.time_step = h;
  record.energy = energy;
  record.gradient_norm = problem.gradient_norm();
  record.largest_move = problem.longest(step);
  record.refactored = record.step == 1;
  report.energy_after = energy;
  report.time_reached = record.time;
  report.steps.push_back(record);
  return record;
}

}  // namespace ibmfair
