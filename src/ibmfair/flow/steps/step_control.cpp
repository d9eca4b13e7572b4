#include "ibmfair/flow/steps/step_control.h"

#include <algorithm>

namespace ibmfair {
namespace {

// The settings of the control, chosen in the same way as the limits of Distortion. A "decrease" is
// the actual decrease of the energy over the predicted one.
constexpr double stale_decrease = 0.1;         // at or below, the Jacobian is renewed
constexpr double good_decrease = 0.5;          // above, a time step that was cut may grow again
constexpr double time_step_cut = 1.0 / 32;     // factor if a step distorts too much or fails
constexpr double growth = 2, fast_growth = 8;  // of the time step; fast if the distortion is < 0.5
constexpr int oldest_when_damped = 4;          // most steps with one Jacobian if regions are damped
constexpr double smallest_time_step = 1e-12;   // relative to the target; below, the flow gives up

}  // namespace

StepControl::StepControl(const FlowOptions& options)
    : total_(options.total_time),
      target_(options.total_time / options.steps),
      h_(target_),
      left_(options.total_time) {}

bool StepControl::has_failed() const {
  return h_ < smallest_time_step * target_;
}

bool StepControl::is_at_last_cut() const {
  return h_ * time_step_cut < smallest_time_step * target_;
}

void StepControl::give_up(bool cut) {
  stale_ = true;
  h_ *= cut ? time_step_cut : 1;
}

void StepControl::advance(double time) {
  left_ = std::max(0.0, left_ - time);
  ++age_;
}

void StepControl::adapt(const StepRecord& made, double whole, double distortion, bool damped,
                        const std::function<double(double, double)>& limited) {
  const bool shortened = made.time_step < whole && left_ > 0;
  if (made.decrease_ratio <= stale_decrease || shortened) {
    stale_ = true;
    h_ *= made.refactored ? 0.5 : 1;
  } else if (made.decrease_ratio > good_decrease && h_ < target_) {
    const double longest = h_ * (distortion < 0.5 ? fast_growth : growth);
    h_ = std::min(target_, limited(growth * h_, longest));
    stale_ = true;
  }
  // A new Jacobian lets regions that no longer raise the energy move at full speed again.
  stale_ = stale_ || (damped && age_ >= oldest_when_damped);
}

}  // namespace ibmfair
