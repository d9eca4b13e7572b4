#include "ibmfair/flow/steps/guarded_flow.h"

#include <algorithm>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/steps/distortion.h"
#include "ibmfair/flow/steps/guarded_relaxation.h"
#include "ibmfair/flow/steps/line_search.h"
#include "ibmfair/flow/steps/local_damping.h"
#include "ibmfair/flow/steps/step_control.h"
#include "ibmfair/flow/steps/step_model.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Relative to the energy: smaller decreases are rounding errors. No tuned constant.
constexpr double rounding = 1e-14;

/// Makes steps until the time is up: StepControl says how long they are, LineSearch how far along
/// the Newton step they go, LocalDamping which vertices are slowed down, and GuardedRelaxation
/// evens the vertices out after each step.
class GuardedFlow {
 public:
  GuardedFlow(FlowProblem& problem, const CompressedRows& rings, const FoldWatch& folds,
              const StepObserver& observer)
      : p_(problem),
        observer_(observer),
        rings_(rings),
        ring_groups_(problem.topology, rings_, problem.unknowns),
        relaxation_(problem, folds, ring_groups_),
        distortion_(ring_groups_, problem.unknowns, problem.parts),
        has_limit_(problem.options.energy_is_dimensionless()),
        control_(problem.options),
        damping_(problem),
        search_(problem, folds, damping_) {}

  Eigen::VectorXd run() {
    relaxation_.relax_needles();
    start_short();
    // Each attempt either advances the time or makes the next attempt easier.
    while (!control_.has_ended() && p_.report.status == FlowStatus::completed) {
      if (control_.has_failed(p_.report.solves)) {
        end_early();
      } else {
        take_step();
      }
    }
    p_.report.shortened_relaxations += relaxation_.failures();
    return damping_.missed();
  }

 private:
  /// Noise decays long before a ripple at the cut-off does, and exerts a second-order force on the
  /// shape while it lasts. A long step, being linear, would apply this force for the whole step:
  /// noisy scans would swell.
  void start_short() {
    if (has_limit_) {
      p_.jacobian().update_metric(p_.X);
    }
    control_.begin(limited_step(tuning.guard.first_step * control_.target(), control_.target()));
  }

  /// The time step that removes the most energy per vertex that a step should remove, between
  /// `shortest` and `longest`; `shortest` if the power is NaN.
  double limited_step(double shortest, double longest) {
    if (!has_limit_) {
      return longest;
    }
    p_.update_gradient();
    const Stopwatch watch(p_.report.seconds.guard);
    return std::min(std::max(shortest, tuning.guard.most_taken / p_.power()), longest);
  }

  /// Makes one attempt at a step.
  void take_step() {
    p_.update_gradient();
    const bool fresh = control_.is_stale();
    if (p_.energy() == 0) {  // flat
      end_at_rest();
    } else if (!fresh || renew_jacobian()) {
      p_.newton_step(step_);
      try_step(fresh);
    }
  }

  /// Factors the Jacobian at the state. If rounding has made the matrix indefinite, the time step
  /// is cut.
  bool renew_jacobian() {
    {
      const Stopwatch watch(p_.report.seconds.guard);
      edge_length_ = local_edge_length(p_.X, rings_);
      damping_.damp();
    }
    try {
      p_.jacobian().refactor(p_.X, control_.time_step());
    } catch (const FactorizationFailed&) {
      if (p_.report.steps.empty() && control_.is_at_last_cut()) {
        throw;
      }
      ++p_.report.rejected;
      control_.give_up(true);
      return false;
    }
    control_.jacobian_was_renewed();
    return true;
  }

  /// Checks the Newton step, and goes along it as far as the energy decreases enough. `fresh`: the
  /// Jacobian was renewed for this step.
  void try_step(bool fresh) {
    const double h = p_.jacobian().time_step(), whole = std::min(1.0, control_.left() / h);
    const StepModel model(p_, step_);
    damping_.begin_step();
    StepRecord record;
    record.refactored = fresh;
    record.gradient_norm = p_.gradient_norm();
    record.held_back = p_.count((p_.jacobian().damping().array() > 1).count());
    // g^T (D/h + S)^-1 g grows at most linearly with h.
    if (control_.target() / h * model.decrease(whole) <= rounding * p_.energy()) {
      end_at_rest();
      return;
    }
    const double distortion = whole * distortion_of_step();
    if (distortion > 1) {
      ++p_.report.rejected;
      control_.give_up(fresh);
      return;
    }
    record.held_back += p_.count(shorten_own_moves(p_.unknowns, own_, edge_length_, step_));
    if (!search_.find(step_, model, whole, control_.is_fresh())) {
      control_.give_up(fresh && !damping_.failed_locally());
      return;
    }
    accept(record);
    control_.adapt(
        record, h, distortion, damping_.is_active(),
        [this](double shortest, double longest) { return limited_step(shortest, longest); });
    record_step(record);
  }

  double distortion_of_step() {
    const Stopwatch watch(p_.report.seconds.guard);
    return distortion_.of(p_.with_others(step_), edge_length_, own_);
  }

  /// Moves to the result of the line search, and relaxes the mesh there.
  void accept(StepRecord& record) {
    const double energy_before = p_.energy();
    const LineSearch::Result& found = search_.result();
    record.step = static_cast<int>(p_.report.steps.size()) + 1;
    record.time_step = found.fraction * p_.jacobian().time_step();
    record.largest_move = p_.longest(found.move);
    record.decrease_ratio = found.decrease_ratio;
    record.held_back += found.held_back;
    control_.advance(record.time_step);
    damping_.end_step(record.time_step);
    record.time = p_.report.time_reached = control_.reached();
    p_.report.energy_after = found.energy;
    search_.move_to_result();
    relaxation_.pull_in_rims(energy_before);
    relaxation_.relax(energy_before);
  }

  void record_step(StepRecord& record) {
    record.energy = p_.report.energy_after;
    p_.report.steps.push_back(record);
    if (observer_ && !observer_(record)) {
      p_.report.status = FlowStatus::interrupted;
    }
  }

  /// Ends the flow at a stationary state: no vertex would move in the remaining time.
  void end_at_rest() {
    control_.end();
    p_.report.time_reached = p_.options.total_time;
  }

  /// Ends the flow before its time. If all vertices are stopped by the bound on moves, the state is
  /// stationary, and the flow is complete.
  void end_early() {
    const auto free = p_.unknowns.size() - static_cast<Index>(p_.stopped().size());
    if (p_.count(free) == 0) {
      end_at_rest();
    } else {
      p_.report.status = FlowStatus::stalled;
    }
  }

  FlowProblem& p_;
  const StepObserver& observer_;
  const CompressedRows& rings_;
  const RingGroups ring_groups_;
  GuardedRelaxation relaxation_;
  Distortion distortion_;
  const bool has_limit_;  // GuardTuning::most_taken limits the time step
  StepControl control_;
  LocalDamping damping_;
  LineSearch search_;
  PerVertex edge_length_;  // at the state at which the Jacobian was renewed
  Points step_;            // the Newton step, one row per unknown
  Points own_;             // the part of the step that neighbours do not share
};

}  // namespace

Eigen::VectorXd run_guarded(FlowProblem& problem, const CompressedRows& rings,
                            const FoldWatch& folds, const StepObserver& observer) {
  return GuardedFlow(problem, rings, folds, observer).run();
}

}  // namespace ibmfair
