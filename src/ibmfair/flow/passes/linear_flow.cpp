#include "ibmfair/flow/passes/linear_flow.h"

namespace ibmfair {

void linearise_flow(FlowProblem& problem, double time, int steps, double tolerance) {
  problem.jacobian().refactor(problem.X, time / steps);
  problem.jacobian().tighten(tolerance);
}

void flow_linearly(FlowProblem& problem, int steps, Points& heights) {
  Points weighted;
  for (int step = 0; step < steps; ++step) {
    weighted = problem.jacobian().metric().asDiagonal() * heights;
    problem.jacobian().solve(weighted, heights);
  }
}

}  // namespace ibmfair
