#include "ibmfair/flow/steps/fold_free_move.h"

#include "ibmfair/flow/tuning.h"

namespace ibmfair {

FoldFreeLanding displace_without_folds(const FlowProblem& problem, const FoldWatch& folds,
                                       Points& move, Points& Y,
                                       const std::function<double(const Points&)>& energy_at) {
  FoldFreeLanding result;
  for (int i = 0; i < tuning.guard.most_withholdings; ++i) {
    result.landing = problem.displace(move, Y);
    if (!result.is_feasible()) {
      return result;
    }
    result.energy = energy_at(Y);
    const std::vector<Index> folding = problem.new_folds(folds, Y, result.energy);
    if (!problem.parts.any(!folding.empty())) {
      return result;
    }
    for (const Index v : folding) {
      if (const Index u = problem.unknowns.unknown[v]; u >= 0 && u < problem.unknowns.size()) {
        move.row(u).setZero();
        ++result.withheld;
      }
    }
  }
  result.landing = FlowProblem::Landing::infeasible;
  return result;
}

}  // namespace ibmfair
