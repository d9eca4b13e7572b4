#include "ibmfair/flow/steps/guarded_flow.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/steps/distortion.h"
#include "ibmfair/flow/steps/fold_free_move.h"
#include "ibmfair/flow/steps/guarded_move.h"
#include "ibmfair/flow/steps/local_damping.h"
#include "ibmfair/flow/steps/step_control.h"
#include "ibmfair/flow/steps/step_model.h"
#include "ibmfair/flow/steps/tangential_relaxation.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

// Relative to the energy: smaller decreases are rounding errors. No tuned constant.
constexpr double rounding = 1e-14;

class GuardedFlow {
 public:
  GuardedFlow(FlowProblem& problem, const CompressedRows& rings, FoldWatch& folds,
              const StepObserver& observer)
      : p_(problem),
        observer_(observer),
        rings_(rings),
        folds_(folds),
        guarded_move_(problem, folds),
        ring_groups_(problem.topology, rings_, problem.unknowns),
        relaxation_(problem.topology, ring_groups_, problem.unknowns, problem.parts,
                    problem.options.sharp_angle > 0),
        measure_(ring_groups_, problem.unknowns, problem.parts),
        has_limit_(problem.options.energy_is_dimensionless()),
        control_(problem.options),
        damping_(problem) {}

  Eigen::VectorXd run() {
    relax_needles();
    start_short();
    take_steps();
    return damping_.missed();
  }

 private:
  void take_steps() {
    // Each attempt either advances the time or makes the next attempt easier.
    const GuardTuning& guard = tuning.guard;
    const int most_solves = p_.options.clean_up
                                ? guard.solves + guard.solves_per_step * p_.options.steps
                                : guard.solves_without_clean_up +
                                      guard.solves_per_step_without_clean_up * p_.options.steps;
    while (!control_.has_ended()) {
      if (control_.has_failed() || p_.report.solves >= most_solves) {
        end_early();
        return;
      }
      if (!take_step()) {
        return;
      }
    }
  }

  /// Ends the flow before its time. If all vertices are stopped by the bound on moves, the state is
  /// stationary, and the flow is complete.
  void end_early() {
    const auto free = p_.unknowns.size() - static_cast<Index>(p_.stopped().size());
    if (count(static_cast<double>(free)) == 0) {
      stay_to_the_end();
    } else {
      p_.report.status = FlowStatus::stalled;
    }
  }

  /// Relaxes the corners of needles. Needles make entries of the Jacobian so large that rounding
  /// swamps the entries of their neighbours, which would then move by chance.
  void relax_needles() {
    p_.update_gradient();
    if (!p_.options.relax || p_.energy() == 0) {
      return;
    }
    const Stopwatch watch(p_.report.seconds.relax);
    if (relaxation_.moves_at_needles(p_.X, move_)) {
      guarded_move_.make(move_, p_.energy());
    }
  }

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

  /// One attempt at a step; false when the observer asks to stop.
  bool take_step() {
    p_.update_gradient();
    if (p_.energy() == 0) {  // flat
      stay_to_the_end();
      return true;
    }
    const bool fresh = control_.is_stale();
    if (fresh && !renew_jacobian()) {
      return true;
    }
    p_.newton_step(step_);
    damping_.begin_step();
    model_ = StepModel(p_, step_);
    StepRecord record;
    record.refactored = fresh;
    record.gradient_norm = p_.gradient_norm();
    record.held_back = count((p_.jacobian().damping().array() > 1).count());
    fraction_ = std::min(1.0, control_.left() / p_.jacobian().time_step());
    // g^T (D/h + S)^-1 g grows at most linearly with h.
    const double longer = control_.target() / p_.jacobian().time_step();
    if (longer * model_.decrease(fraction_) <= rounding * p_.energy()) {
      stay_to_the_end();
      return true;
    }
    if (distorts()) {
      ++p_.report.rejected;
      control_.give_up(fresh);
      return true;
    }
    record.held_back += shorten_own_moves();
    if (!search(record)) {
      control_.give_up(fresh && !damping_.failed_locally());
      return true;
    }
    accept(record);
    relax();
    control_.adapt(
        record, p_.jacobian().time_step(), distortion_, damping_.is_active(),
        [this](double shortest, double longest) { return limited_step(shortest, longest); });
    record.energy = p_.report.energy_after;
    p_.report.steps.push_back(record);
    const bool go_on = !observer_ || observer_(record);
    if (!go_on) {
      p_.report.status = FlowStatus::interrupted;
    }
    return go_on;
  }

  /// Ends the flow at a stationary state: no vertex would move in the remaining time.
  void stay_to_the_end() {
    control_.end();
    p_.report.time_reached = p_.options.total_time;
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

  bool distorts() {
    const Stopwatch watch(p_.report.seconds.guard);
    const Points& all = p_.with_others(step_);
    distortion_ = fraction_ * measure_.of(all, edge_length_, own_);
    return distortion_ > 1;
  }

  /// Limits the part of each move that the neighbours do not share to the mean edge length at the
  /// vertex. Returns the number of shortened moves.
  std::int64_t shorten_own_moves() {
    const double shortened = parallel_sum(p_.unknowns.size(), [&](std::int64_t u) {
      const double limit = edge_length_[p_.unknowns.vertex[u]];
      const double length = own_.row(u).norm();
      if (!(length > limit)) {
        return 0;
      }
      step_.row(u) -= (1 - limit / length) * own_.row(u);
      return 1;
    });
    return count(shortened);
  }

  /// The sum of a count over all parts.
  std::int64_t count(double here) const { return static_cast<std::int64_t>(p_.parts.sum(here)); }

  /// Looks for a fraction of the step that lowers the energy enough, and leaves the result in Y_.
  bool search(StepRecord& record) {
    const Stopwatch watch(p_.report.seconds.guard);
    damping_.reset();
    for (int i = 0; i <= tuning.guard.most_halvings; ++i, fraction_ /= 2) {
      move_.resize(step_.rows(), 3);
      parallel_for(step_.rows(), [&](std::int64_t u) { move_.row(u) = fraction_ * step_.row(u); });
      if (try_move(record)) {
        return true;
      }
      ++p_.report.rejected;
    }
    return false;
  }

  /// Tries `move_`. Where the move raises the energy it is repeatedly shortened, so that one bad
  /// spot does not stop the whole mesh.
  bool try_move(StepRecord& record) {
    std::int64_t shortened = 0;
    for (int times = 0;; ++times) {
      const FoldFreeLanding trial = displace_without_folds(
          p_, folds_, move_, Y_, [this](const Points& Y) { return p_.energy_at(Y); });
      if (!trial.leads_somewhere()) {
        return false;
      }
      shortened += trial.withheld;
      const bool whole =
          trial.landing == FlowProblem::Landing::as_asked && !p_.parts.any(shortened > 0);
      const double promised = whole ? model_.decrease(fraction_) : promised_on_the_way();
      trial_energy_ = trial.energy;
      record.decrease_ratio = (p_.energy() - trial_energy_) / promised;
      if (record.decrease_ratio >= tuning.guard.least_decrease) {
        record.held_back += count(static_cast<double>(shortened));
        return true;
      }
      if (times == tuning.guard.most_slowings ||
          !damping_.slow(Y_, control_.is_fresh(), move_, shortened)) {
        return false;
      }
    }
  }

  /// The predicted decrease for a trial in Y_ whose move was shortened at some vertices: half of
  /// the first-order decrease. If the first-order change is an increase, it is due to a needle and
  /// stops after a tiny part of the move; then the prediction for the whole step applies.
  double promised_on_the_way() const {
    const double slope = p_.parts.sum(parallel_sum(p_.unknowns.size(), [&](std::int64_t u) {
      const Index v = p_.unknowns.vertex[u];
      return -p_.gradient().row(u).dot(Y_.row(v) - p_.X.row(v));
    }));
    return slope > 0 ? std::min(slope / 2, p_.energy()) : model_.decrease(fraction_);
  }

  void accept(StepRecord& record) {
    energy_before_step_ = p_.energy();
    record.step = static_cast<int>(p_.report.steps.size()) + 1;
    record.time_step = fraction_ * p_.jacobian().time_step();
    record.largest_move = p_.longest(move_);
    control_.advance(record.time_step);
    damping_.end_step(record.time_step);
    record.time = p_.report.time_reached = control_.reached();
    p_.report.energy_after = trial_energy_;
    p_.move_to(Y_);
  }

  void relax() {
    if (!p_.options.relax) {
      return;
    }
    const Stopwatch watch(p_.report.seconds.relax);
    relaxation_.moves(p_.X, move_);
    guarded_move_.make(move_, energy_before_step_);
  }

  FlowProblem& p_;
  const StepObserver& observer_;
  const CompressedRows& rings_;
  FoldWatch& folds_;
  GuardedMove guarded_move_;
  const RingGroups ring_groups_;
  TangentialRelaxation relaxation_;
  Distortion measure_;
  const bool has_limit_;  // GuardTuning::most_taken limits the time step
  StepControl control_;
  LocalDamping damping_;
  PerVertex edge_length_;
  double fraction_ = 1;  // the fraction of the Newton step to try
  StepModel model_;      // along the Newton step
  double distortion_ = 0;
  double trial_energy_ = 0, energy_before_step_ = 0;
  Points step_;  // the Newton step, one row per unknown
  Points own_;   // the part of the step that neighbours do not share
  Points move_;  // the move to try, one row per unknown
  Points Y_;     // the state after `move_`
};

}  // namespace

Eigen::VectorXd run_guarded(FlowProblem& problem, const CompressedRows& rings, FoldWatch& folds,
                            const StepObserver& observer) {
  return GuardedFlow(problem, rings, folds, observer).run();
}

}  // namespace ibmfair
