#include "ibmfair/flow/steps/plain_flow.h"

#include <cmath>

namespace ibmfair {

void run_plain(FlowProblem& problem, const StepObserver& observer) {
  FlowReport& report = problem.report;
  const double h = problem.options.total_time / problem.options.steps;
  problem.jacobian().refactor(problem.X, h);
  Points step, Y;
  for (int k = 1; k <= problem.options.steps; ++k) {
    problem.update_gradient();
    problem.newton_step(step);
    const bool lands = problem.displace(step, Y) != FlowProblem::Landing::infeasible;
    const double energy = problem.energy_at(Y);
    if (!lands || !std::isfinite(energy) || problem.parts.any(!Y.allFinite())) {
      report.status = FlowStatus::diverged;
      return;
    }
    problem.move_to(Y);
    report.energy_after = energy;
    report.time_reached = k * h;
    StepRecord record;
    record.step = k;
    record.time = k * h;
    record.time_step = h;
    record.energy = energy;
    record.gradient_norm = problem.gradient_norm();
    record.largest_move = problem.longest(step);
    record.refactored = k == 1;
    report.steps.push_back(record);
    if (observer && !observer(record)) {
      report.status = FlowStatus::interrupted;
      return;
    }
  }
}

}  // namespace ibmfair
