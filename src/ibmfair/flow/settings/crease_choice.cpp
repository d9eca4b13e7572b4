#include "ibmfair/flow/settings/crease_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ibmfair/base/angle.h"
#include "ibmfair/flow/settings/added_noise.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/trial_mesh.h"

namespace ibmfair {
namespace {

double shape_risk(const CutoffTrial& trial) {
  return trial.risk + choice_tuning.creases.slopes * trial.slope_risk;
}

class CreaseSearch {
 public:
  CreaseSearch(const TrialMesh& mesh, const CutoffChoice& without, const CutoffSearch& search)
      : mesh_(mesh),
        without_(without),
        search_(search),
        start_(std::max(choice_tuning.creases.first_cutoff * mesh.mean_edge_length(),
                        without.noise.is_white() ? 0 : without.cutoff)),
        added_(mesh, without.noise, with(choice_tuning.creases.first_angle), start_) {}

  /// Whether a choice leaves less than this share of what is left without creases, and by at least
  /// `least` (length^2) less. If distances alone do not tell, slopes count as well. If the noise is
  /// correlated, both count, and any difference: it hides most of what creases gain.
  bool is_below(const CreaseChoice& choice, double share, double least = 0) const {
    const CutoffTrial &with = choice.cutoff.best(), &without = without_.best();
    if (!without_.noise.is_white()) {
      return with.total() < without.total();
    }
    const auto below = [&](double with_creases, double without_creases) {
      return with_creases < share * without_creases && with_creases < without_creases - least;
    };
    return below(with.risk, without.risk) ||
           (with.risk < choice_tuning.creases.hopeless * without.risk &&
            below(shape_risk(with), shape_risk(without)));
  }

  /// The differences of risks (length^2) that may be chance.
  double chance() const {
    return choice_tuning.creases.chance * without_.noise.variance() /
           std::sqrt(static_cast<double>(added_.counted()));
  }

  /// Whether the noise is a mixture, because creases do not explain what looks like one. The
  /// bluntest angle keeps the most creases.
  bool finds_mixed_noise() const {
    NoisierFlows flows(added_, with(std::ranges::min(choice_tuning.creases.blunter_angles)));
    const double shorter = trial(flows, start_ / 2).risk;
    return trial(flows, start_).risk - shorter >
           choice_tuning.creases.clear_rise * without_.noise.variance();
  }

  /// The best cut-off for the first angle.
  CreaseChoice with_first_angle() const {
    CreaseChoice choice{radians(choice_tuning.creases.first_angle), without_};
    NoisierFlows flows(added_, with(choice_tuning.creases.first_angle));
    // Creases allow longer cut-offs than without; with correlated noise much longer ones.
    const double hopeless =
        without_.noise.is_white() ? without_.best().risk : std::numeric_limits<double>::infinity();
    choice.cutoff.trials = trials_around([&](double cutoff) { return trial(flows, cutoff); },
                                         {.start = start_,
                                          .shortest = without_.cutoff / std::pow(2.0, 0.25),
                                          .largest = search_.largest,
                                          .hopeless = hopeless,
                                          .tolerance = tolerance()});
    choice.cutoff.cutoff = cutoff_of_least_risk(choice.cutoff.trials, true);
    return choice;
  }

  /// Goes on to blunter angles as long as none leaves more of the distance: of two that leave about
  /// the same, the blunter one keeps more of the mesh. If the first of them leaves clearly more,
  /// slopes included, goes on to sharper ones as long as each leaves clearly less. All are tried at
  /// the cut-off of the first. With a blunter angle, which keeps more, the best cut-off is longer:
  /// about as the angle to the power -0.2 on benchmark shapes.
  void try_other_angles(CreaseChoice& best) const {
    const double clear = choice_tuning.creases.clear_gain * without_.noise.variance();
    const double before = best.sharp_angle;
    const CutoffTrial first = best.cutoff.best();
    std::optional<CutoffTrial> blunter;
    for (const double angle : choice_tuning.creases.blunter_angles) {
      const CutoffTrial next = trial_with(angle, first.cutoff);
      blunter = blunter.value_or(next);
      if (!(next.risk < best.cutoff.best().risk + tolerance())) {
        break;
      }
      take(angle, next, best);
    }
    best.cutoff.cutoff *= std::pow(before / best.sharp_angle, 0.2);
    if (!(shape_risk(*blunter) > shape_risk(first) + clear)) {
      return;
    }
    for (const double angle : choice_tuning.creases.sharper_angles) {
      const CutoffTrial next = trial_with(angle, first.cutoff);
      if (!(shape_risk(next) < shape_risk(best.cutoff.best()) - clear)) {
        break;
      }
      take(angle, next, best);
    }
  }

 private:
  static void take(double angle, const CutoffTrial& trial, CreaseChoice& choice) {
    choice.sharp_angle = radians(angle);
    choice.cutoff.trials = {trial};
  }

  /// With this angle (degrees), by the same cut-offs as the flows with the first angle, for a fair
  /// comparison.
  CutoffTrial trial_with(double angle, double last) const {
    NoisierFlows flows(added_, with(angle));
    for (double cutoff = start_; cutoff < 0.9 * last; cutoff *= std::sqrt(2.0)) {
      flows.flow_to(cutoff);
    }
    return trial(flows, last);
  }

  double tolerance() const { return choice_tuning.cutoff.small_gain * without_.noise.variance(); }

  /// The options that keep creases of more than this angle (degrees).
  FlowOptions with(double angle) const {
    FlowOptions options = mesh_.options();
    options.sharp_angle = radians(angle);
    return options;
  }

  CutoffTrial trial(NoisierFlows& flows, double cutoff) const {
    search_.tell(cutoff);
    return flows.trial(cutoff);
  }

  const TrialMesh& mesh_;
  const CutoffChoice& without_;
  const CutoffSearch& search_;
  const double start_;  // the first cut-off, length
  const AddedNoise added_;
};

}  // namespace

CreaseFindings choose_creases(const Points& X, const Topology& topology,
                              const std::vector<std::uint8_t>& fixed, const FlowOptions& keeping,
                              const CutoffChoice& without, const CutoffSearch& search) {
  // Where the flow without creases may leave nothing, creases cannot be found to leave less.
  const double least =
      std::max(choice_tuning.creases.least_risk * without.noise.variance(), without.risk_error);
  const bool may_gain = without.best().risk > least;
  const bool may_be_mixed = without.mixed_noise.deviation > 0;
  if (!may_gain && !may_be_mixed) {
    return {};
  }
  const TrialMesh mesh(X, topology, fixed, keeping, search.sample_for(without.noise));
  const CreaseSearch creases(mesh, without, search);
  if (may_be_mixed && creases.finds_mixed_noise()) {
    return {.noise_is_mixed = true, .choice = std::nullopt};
  }
  if (!may_gain) {
    return {};
  }
  CreaseChoice best = creases.with_first_angle();
  if (!creases.is_below(best, choice_tuning.creases.some_share)) {
    return {};
  }
  creases.try_other_angles(best);
  if (!creases.is_below(best, choice_tuning.creases.clear_share, creases.chance())) {
    return {};
  }
  return {.choice = best};
}

}  // namespace ibmfair
