#include "ibmfair/flow/steps/guarded_move.h"

#include "ibmfair/flow/steps/fold_free_move.h"

namespace ibmfair {

bool GuardedMove::make(Points& move, double bound, int most_halvings) {
  for (int i = 0; i <= most_halvings; ++i, move /= 2) {
    const FoldFreeLanding trial = displace_without_folds(
        problem_, folds_, move, Y_, [this](const Points& Y) { return problem_.try_state(Y); });
    if (trial.is_feasible() && trial.energy <= bound) {
      problem_.report.energy_after = trial.energy;
      problem_.move_to_tried(Y_);
      return true;
    }
    ++failures_;
  }
  return false;
}

}  // namespace ibmfair
