#include "ibmfair/flow/passes/linear_flow.h"

namespace ibmfair {
namespace {

constexpr double tolerance = 1e-3;  // of solves, as no later step removes their residual

}  // namespace

void linearise_flow(FlowProblem& problem, double time, int steps) {
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
