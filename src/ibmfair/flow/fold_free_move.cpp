#include "ibmfair/flow/fold_free_move.h"

namespace ibmfair {

FlowProblem::Landing displace_without_folds(const FlowProblem& problem, FoldWatch& folds,
                                            Points& move, Points& Y, std::int64_t& withheld) {
  constexpr int passes = 6;
  for (int pass = 0; pass < passes; ++pass) {
    const FlowProblem::Landing landing = problem.displace(move, Y);
    if (landing == FlowProblem::Landing::nowhere) {
      return landing;
    }
    const std::vector<Index> folding = folds.new_folds(Y);
    if (!problem.parts.any(!folding.empty())) {
      return landing;
    }
    for (const Index v : folding) {
      if (const Index u = problem.unknowns.unknown[v]; u >= 0 && u < problem.unknowns.size()) {
        move.row(u).setZero();
        ++withheld;
      }
    }
  }
  return FlowProblem::Landing::nowhere;
}

}  // namespace ibmfair
