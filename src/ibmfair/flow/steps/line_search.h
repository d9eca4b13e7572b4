// The line search of a guarded step: how far to go along a Newton step, and which vertices to slow
// down, so that the energy decreases enough (J. Nocedal, S. J. Wright, "Numerical Optimization",
// section 3.1: backtracking with a condition of sufficient decrease).
#pragma once

#include <cstdint>

#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/steps/local_damping.h"
#include "ibmfair/flow/steps/step_model.h"

namespace ibmfair {

/// Searches along the Newton steps of one problem.
class LineSearch {
 public:
  /// All arguments must outlive this object. The state of `folds` is that of the problem.
  LineSearch(FlowProblem& problem, const FoldWatch& folds, LocalDamping& damping)
      : problem_(problem), folds_(folds), damping_(damping) {}

  /// The accepted move.
  struct Result {
    double fraction = 0;         ///< of the step
    double energy = 0;           ///< after the move
    double decrease_ratio = 0;   ///< actual over predicted decrease of the energy
    std::int64_t held_back = 0;  ///< vertices whose move was shortened or withheld, in all parts
    Points move;                 ///< one row per unknown, length
  };

  /// Looks for a move along `step` (one row per unknown, length) that folds no hinge over and
  /// lowers the energy by a sufficient share of the decrease that `model` predicts. Tries the part
  /// `fraction` of the step and its halves. Where a few uphill vertices are the cause of a failure,
  /// the move is shortened there first (LocalDamping), so that one bad spot does not stop the whole
  /// mesh. `fresh`: no step has been made with the present Jacobian yet. Returns false if no move
  /// is found.
  bool find(const Points& step, const StepModel& model, double fraction, bool fresh);

  /// Precondition: `find` has returned true.
  const Result& result() const { return result_; }

  /// Moves the problem's state by the result. Precondition: `find` has returned true.
  void move_to_result() { problem_.move_to(Y_); }

 private:
  bool try_move(const StepModel& model, bool fresh);
  double predicted_on_the_way(const StepModel& model) const;

  FlowProblem& problem_;
  const FoldWatch& folds_;
  LocalDamping& damping_;
  Result result_;
  Points Y_;  // the state after the move
};

}  // namespace ibmfair
