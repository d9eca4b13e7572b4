// How long the time steps of a guarded flow are, and when its Jacobian is renewed: both adapt to
// the agreement between the actual and the predicted decrease of the energy, as the radius of a
// trust region does (J. Nocedal, S. J. Wright, "Numerical Optimization", chapter 4).
#pragma once

#include <functional>

#include "ibmfair/flow/flow_options.h"

namespace ibmfair {

/// The time that is left, the next time step, and the age of the Jacobian.
class StepControl {
 public:
  /// Time is in the flow's unit. Begins with `options.steps` steps of equal length as the target.
  explicit StepControl(const FlowOptions& options);

  double target() const { return target_; }  ///< the length of a step
  double time_step() const { return h_; }    ///< the length of the next one
  double left() const { return left_; }      ///< the remaining time
  double reached() const { return total_ - left_; }
  bool has_ended() const { return left_ <= 1e-9 * total_; }  ///< up to rounding errors
  bool is_stale() const { return stale_; }  ///< the Jacobian has to be renewed before the next step
  bool is_fresh() const { return age_ == 0; }  ///< no step was made with the Jacobian

  /// Whether the flow must end early: time steps have become too short, or `solves` linear systems
  /// are too many (GuardTuning::solves).
  bool has_failed(int solves = 0) const;
  /// Whether they would be after the next cut.
  bool is_at_last_cut() const;

  /// Sets the length of the first step.
  void begin(double h) { h_ = h; }

  /// Ends the flow at a stationary state.
  void end() { left_ = 0; }

  void jacobian_was_renewed() {
    stale_ = false;
    age_ = 0;
  }

  /// No vertex was moved: the next attempt renews the Jacobian. `cut`: it also cuts the time step,
  /// because a new Jacobian alone would lead to the same result.
  void give_up(bool cut);

  /// A step of length `time` was made.
  void advance(double time);

  /// Chooses the next time step, and whether the Jacobian has to be renewed. `made`: the last step,
  /// `whole`: the length that the Jacobian was made for, `distortion`: of the step (distortion.h),
  /// `damped`: regions are slowed down. `limited(shortest, longest)` must give a time step between
  /// both that removes little energy.
  void adapt(const StepRecord& made, double whole, double distortion, bool damped,
             const std::function<double(double, double)>& limited);

 private:
  double total_, target_, h_, left_;
  int most_solves_;
  bool stale_ = true;
  int age_ = 0;  // steps made with the Jacobian
};

}  // namespace ibmfair
