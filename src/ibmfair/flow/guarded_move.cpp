#include "ibmfair/flow/guarded_move.h"

#include "ibmfair/flow/fold_free_move.h"

namespace ibmfair {
namespace {

constexpr int halvings = 2;  // before the move is given up

}  // namespace

bool GuardedMove::make(Points& move, double bound) {
  FlowReport& report = problem_.report;
  for (int i = 0; i <= halvings; ++i, move /= 2) {
    const FoldFreeLanding trial = displace_without_folds(
        problem_, folds_, move, Y_, [this](const Points& Y) { return problem_.try_state(Y); });
    if (trial.leads_somewhere() && trial.energy <= bound) {
      report.energy_after = trial.energy;
      problem_.move_to_tried(Y_);
      return true;
    }
    ++report.shortened_relaxations;
  }
  return false;
}

}  // namespace ibmfair
