#include "ibmfair/flow/steps/step_control.h"

#include <algorithm>

#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

int most_solves(const FlowOptions& options) {
  const GuardTuning& guard = tuning.guard;
  return options.clean_up ? guard.solves + guard.solves_per_step * options.steps
                          : guard.solves_without_clean_up +
                                guard.solves_per_step_without_clean_up * options.steps;
}

}  // namespace

StepControl::StepControl(const FlowOptions& options)
    : total_(options.total_time),
      target_(options.total_time / options.steps),
      h_(target_),
      left_(options.total_time),
      most_solves_(most_solves(options)) {}

bool StepControl::has_failed(int solves) const {
  return h_ < tuning.step_control.smallest * target_ || solves >= most_solves_;
}

bool StepControl::is_at_last_cut() const {
  return h_ * tuning.step_control.cut < tuning.step_control.smallest * target_;
}

void StepControl::give_up(bool cut) {
  stale_ = true;
  h_ *= cut ? tuning.step_control.cut : 1;
}

void StepControl::advance(double time) {
  left_ = std::max(0.0, left_ - time);
  ++age_;
}

void StepControl::adapt(const StepRecord& made, double whole, double distortion, bool damped,
                        const std::function<double(double, double)>& limited) {
  const bool shortened = made.time_step < whole && left_ > 0;
  if (shortened) {
    stale_ = true;
    h_ *= made.refactored ? tuning.step_control.shortened : 1;
  } else if (made.decrease_ratio > tuning.guard.good_decrease && h_ < target_) {
    const bool fast = distortion < tuning.step_control.little_distortion;
    const double longest =
        h_ * (fast ? tuning.step_control.fast_growth : tuning.step_control.growth);
    h_ = std::min(target_, limited(tuning.step_control.growth * h_, longest));
    stale_ = true;
  }
  // A new Jacobian lets regions that no longer raise the energy move at full speed again.
  stale_ = stale_ || (damped && age_ >= tuning.step_control.oldest_when_damped);
}

}  // namespace ibmfair
