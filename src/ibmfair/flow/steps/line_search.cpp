#include "ibmfair/flow/steps/line_search.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/steps/fold_free_move.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {

bool LineSearch::find(const Points& step, const StepModel& model, double fraction, bool fresh) {
  const Stopwatch watch(problem_.report.seconds.guard);
  result_.fraction = fraction;
  for (int i = 0; i <= tuning.guard.most_halvings; ++i, result_.fraction /= 2) {
    result_.move.resize(step.rows(), 3);
    parallel_for(step.rows(),
                 [&](std::int64_t u) { result_.move.row(u) = result_.fraction * step.row(u); });
    if (try_move(model, fresh)) {
      return true;
    }
    ++problem_.report.rejected;
  }
  return false;
}

/// Tries the move, and shortens it near uphill vertices if that may help.
bool LineSearch::try_move(const StepModel& model, bool fresh) {
  std::int64_t shortened = 0;
  for (int slowings = 0;; ++slowings) {
    const FoldFreeLanding trial =
        displace_without_folds(problem_, folds_, result_.move, Y_,
                               [this](const Points& Y) { return problem_.energy_at(Y); });
    if (!trial.is_feasible()) {
      return false;
    }
    shortened += trial.withheld;
    const bool whole =
        trial.landing == FlowProblem::Landing::complete && !problem_.parts.any(shortened > 0);
    const double predicted = whole ? model.decrease(result_.fraction) : predicted_on_the_way(model);
    result_.energy = trial.energy;
    result_.decrease_ratio = (problem_.energy() - trial.energy) / predicted;
    if (result_.decrease_ratio >= tuning.guard.least_decrease) {
      result_.held_back = problem_.count(shortened);
      return true;
    }
    if (slowings == tuning.guard.most_slowings ||
        !damping_.slow(Y_, fresh, result_.move, shortened)) {
      return false;
    }
  }
}

/// The predicted decrease for a trial in Y_ whose move was shortened at some vertices: half of the
/// first-order decrease. If the first-order change is an increase, it is due to a needle and stops
/// after a tiny part of the move; then the prediction for the whole step applies.
double LineSearch::predicted_on_the_way(const StepModel& model) const {
  const Unknowns& unknowns = problem_.unknowns;
  const double slope = problem_.parts.sum(parallel_sum(unknowns.size(), [&](std::int64_t u) {
    const Index v = unknowns.vertex[u];
    return -problem_.gradient().row(u).dot(Y_.row(v) - problem_.X.row(v));
  }));
  return slope > 0 ? std::min(slope / 2, problem_.energy()) : model.decrease(result_.fraction);
}

}  // namespace ibmfair
