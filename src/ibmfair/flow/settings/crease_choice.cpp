#include "ibmfair/flow/settings/crease_choice.h"

#include <cmath>

#include "ibmfair/base/angle.h"
#include "ibmfair/flow/settings/added_noise.h"
#include "ibmfair/flow/settings/trial_mesh.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

class CreaseSearch {
 public:
  CreaseSearch(const TrialMesh& mesh, const CutoffChoice& without, const CutoffSearch& search)
      : mesh_(mesh),
        without_(without),
        search_(search),
        start_(tuning.creases.first_cutoff * mesh.mean_edge_length()),
        added_(mesh, without.noise, with(tuning.creases.first_angle), start_) {}

  /// Whether a choice leaves less than this share of the risk without creases, and the difference
  /// is no chance.
  bool is_below(const CreaseChoice& choice, double share) const {
    const double risk = choice.cutoff.best().risk, bending = without_.best().risk;
    const double chance = tuning.creases.chance * without_.noise * without_.noise /
                          std::sqrt(static_cast<double>(added_.counted()));
    return risk < share * bending && risk < bending - chance;
  }

  /// The best cut-off for the first angle.
  CreaseChoice with_first_angle() const {
    CreaseChoice choice{radians(tuning.creases.first_angle), without_};
    NoisierFlows flows(added_, with(tuning.creases.first_angle));
    // Creases allow longer cut-offs than without.
    choice.cutoff.trials = trials_around([&](double cutoff) { return risk(flows, cutoff); },
                                         {.start = start_,
                                          .shortest = without_.cutoff,
                                          .largest = search_.largest,
                                          .hopeless = without_.best().risk,
                                          .tolerance = tolerance()});
    choice.cutoff.cutoff = cutoff_of_least_risk(choice.cutoff.trials, true);
    return choice;
  }

  /// Goes on to the angles (degrees) as long as each reduces the risk clearly. The cut-off stays:
  /// the best one depends little on the angle. Returns whether the first angle has raised the risk
  /// clearly.
  template <class Angles>
  bool go_on(const Angles& angles, CreaseChoice& best) const {
    const double clear = tuning.creases.clear_gain * without_.noise * without_.noise;
    bool raised = false;
    for (const double angle : angles) {
      const CutoffTrial last = best.cutoff.best();
      NoisierFlows flows(added_, with(angle));
      const double next = risk(flows, last.cutoff);
      if (!(last.risk - next > clear)) {
        raised = angle == angles[0] && next - last.risk > clear;
        break;
      }
      best.sharp_angle = radians(angle);
      best.cutoff.trials = {{last.cutoff, next}};
    }
    return raised;
  }

 private:
  double tolerance() const { return tuning.cutoff.small_gain * without_.noise * without_.noise; }

  /// The options that keep creases of more than this angle (degrees).
  FlowOptions with(double angle) const {
    FlowOptions options = mesh_.options();
    options.sharp_angle = radians(angle);
    return options;
  }

  double risk(NoisierFlows& flows, double cutoff) const {
    if (search_.observer) {
      search_.observer(cutoff);
    }
    return flows.risk(cutoff);
  }

  const TrialMesh& mesh_;
  const CutoffChoice& without_;
  const CutoffSearch& search_;
  const double start_;  // the first cut-off, length
  const AddedNoise added_;
};

}  // namespace

std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& fixed,
                                           const FlowOptions& keeping, const CutoffChoice& without,
                                           const CutoffSearch& search) {
  const double variance = without.noise * without.noise;
  if (!(without.best().risk > tuning.creases.least_risk * variance)) {
    return std::nullopt;
  }
  const TrialMesh mesh(X, topology, fixed, keeping, search.enough);
  const CreaseSearch creases(mesh, without, search);
  CreaseChoice best = creases.with_first_angle();
  if (!creases.is_below(best, tuning.creases.some_share)) {
    return std::nullopt;
  }
  // Where a blunter angle leaves about as much, a sharper one leaves more.
  if (creases.go_on(tuning.creases.blunter_angles, best)) {
    creases.go_on(tuning.creases.sharper_angles, best);
  }
  if (!creases.is_below(best, tuning.creases.clear_share)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ibmfair
