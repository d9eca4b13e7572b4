// Moves of the flow's state besides its time steps, such as those of relaxation: they do not raise
// the energy beyond a bound, and fold no hinge over.
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {

/// Makes moves of one problem, and counts its failures.
class GuardedMove {
 public:
  /// Both must outlive this object. The state of `folds` is that of the problem.
  GuardedMove(FlowProblem& problem, const FoldWatch& folds) : problem_(problem), folds_(folds) {}

  /// Moves the state by `move` (one row per unknown, length), halved until the energy is at most
  /// `bound`. Leaves the move that was made in `move`. Returns false, without a move, if even the
  /// shortest move raises the energy further.
  bool make(Points& move, double bound, int most_halvings = tuning.guard.most_halvings);

  /// The number of trials that raised the energy too far.
  int failures() const { return failures_; }

 private:
  FlowProblem& problem_;
  const FoldWatch& folds_;
  int failures_ = 0;
  Points Y_;  // the state after `move`; reused
};

}  // namespace ibmfair
