#include "ibmfair/flow/passes/restored_quantities.h"

#include "ibmfair/flow/steps/guarded_move.h"

namespace ibmfair {

void restore_quantities(FlowProblem& problem) {
  FlowReport& report = problem.report;
  const FoldWatch folds(problem.X, problem.topology);
  Points move = problem.resume_quantities();
  if (!GuardedMove(problem, folds).make(move, report.energy_before, 0)) {
    Points start = problem.start();
    problem.move_to(start);
    report.energy_after = report.energy_before;
    report.time_reached = 0;
    report.status = FlowStatus::stalled;
  }
}

}  // namespace ibmfair
