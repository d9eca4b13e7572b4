#include "ibmfair/flow/steps/guarded_relaxation.h"

#include "ibmfair/base/stopwatch.h"

namespace ibmfair {

void GuardedRelaxation::relax_needles() {
  problem_.update_gradient();
  if (!problem_.options.relax || problem_.energy() == 0) {
    return;
  }
  const Stopwatch watch(problem_.report.seconds.relax);
  if (relaxation_.moves_at_needles(problem_.X, moves_)) {
    moves_ *= problem_.options.relaxation;
    move_.make(moves_, problem_.energy());
  }
}

void GuardedRelaxation::relax(double bound) {
  if (problem_.options.relax) {
    const Stopwatch watch(problem_.report.seconds.relax);
    relaxation_.moves(problem_.X, moves_);
    if (problem_.options.relaxation != 1) {
      moves_ *= problem_.options.relaxation;
    }
    move_.make(moves_, bound);
  }
}

void GuardedRelaxation::pull_in_rims(double bound) {
  const Stopwatch watch(problem_.report.seconds.relax);
  const bool pulls_here = problem_.rims().pull_in(problem_.X, moves_);
  if (!problem_.parts.any(pulls_here)) {
    return;
  }
  if (!pulls_here) {
    moves_ = Points::Zero(problem_.unknowns.size(), 3);
  }
  move_.make(moves_, bound);
}

}  // namespace ibmfair
