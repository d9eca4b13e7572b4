// Tangential relaxation of the flow's state under the guard: it does not raise the energy beyond a
// bound, and folds no hinge over.
#pragma once

#include "ibmfair/flow/steps/guarded_move.h"
#include "ibmfair/flow/steps/tangential_relaxation.h"

namespace ibmfair {

/// Does nothing unless `FlowOptions::relax` is set. Adds its time to the report.
class GuardedRelaxation {
 public:
  /// All arguments must outlive this object. The state of `folds` is that of the problem.
  GuardedRelaxation(FlowProblem& problem, const FoldWatch& folds, const RingGroups& rings)
      : problem_(problem), move_(problem, folds), relaxation_(problem, rings) {}

  /// Relaxes the corners of needles. Needles make entries of the Jacobian so large that rounding
  /// swamps the entries of their neighbours, which would then move by chance.
  void relax_needles();

  /// Makes one sweep that leaves the energy at most at `bound`.
  void relax(double bound);

  /// Makes the moves of FreeRims::pull_in that leave the energy at most at `bound`, whatever the
  /// options say.
  void pull_in_rims(double bound);

  /// The number of sweeps that had to be shortened or withheld.
  int failures() const { return move_.failures(); }

 private:
  FlowProblem& problem_;
  GuardedMove move_;
  TangentialRelaxation relaxation_;
  Points moves_;  // one row per unknown, reused
};

}  // namespace ibmfair
