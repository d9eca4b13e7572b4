#include "ibmfair/flow/settings/crease_choice.h"

#include <algorithm>
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

  /// Whether a choice leaves less than this share of the risk without creases.
  bool is_below(const CreaseChoice& choice, double share) const {
    return choice.cutoff.best().risk < share * without_.best().risk;
  }

  /// Whether it leaves so much less that the difference is no chance.
  bool is_no_chance(const CreaseChoice& choice) const {
    const double chance = tuning.creases.chance * without_.noise * without_.noise /
                          std::sqrt(static_cast<double>(added_.counted()));
    return choice.cutoff.best().risk < without_.best().risk - chance;
  }

  /// The best cut-off for the first angle.
  CreaseChoice with_first_angle() const {
    CreaseChoice choice{radians(tuning.creases.first_angle), without_};
    NoisierFlows flows(added_, with(tuning.creases.first_angle));
    // Creases allow longer cut-offs than without.
    choice.cutoff.trials = trials_around([&](double cutoff) { return risk(flows, cutoff); },
                                         {.start = start_,
                                          .shortest = without_.cutoff / std::pow(2.0, 0.25),
                                          .largest = search_.largest,
                                          .hopeless = without_.best().risk,
                                          .tolerance = tolerance()});
    choice.cutoff.cutoff = cutoff_of_least_risk(choice.cutoff.trials, true);
    return choice;
  }

  /// Goes on to blunter angles as long as none leaves more: of two that leave about the same, the
  /// blunter one keeps more of the mesh. If the first of them leaves clearly more, goes on to
  /// sharper ones as long as each leaves clearly less. All are tried at the cut-off of the first.
  /// With a blunter angle, which keeps more, the best cut-off is longer: about as the angle to the
  /// power -0.2 on benchmark shapes.
  void try_other_angles(CreaseChoice& best) const {
    const double clear = tuning.creases.clear_gain * without_.noise * without_.noise;
    const double before = best.sharp_angle;
    const double first = go_on(tuning.creases.blunter_angles, tolerance(), best);
    best.cutoff.cutoff *= std::pow(before / best.sharp_angle, 0.2);
    if (first > clear) {
      go_on(tuning.creases.sharper_angles, -clear, best);
    }
  }

 private:
  /// Takes the angles (degrees) one after the other as long as the risk rises by less than `most`
  /// (length^2; falls, if negative) from each to the next. Returns by how much the first raises it.
  template <class Angles>
  double go_on(const Angles& angles, double most, CreaseChoice& best) const {
    double first = 0;
    for (const double angle : angles) {
      const CutoffTrial last = best.cutoff.best();
      NoisierFlows flows(added_, with(angle));
      // By the same cut-offs as the flows with the first angle, for a fair comparison.
      for (double cutoff = start_; cutoff < 0.9 * last.cutoff; cutoff *= std::sqrt(2.0)) {
        flows.flow_to(cutoff);
      }
      const double next = risk(flows, last.cutoff), rise = next - last.risk;
      first = angle == angles[0] ? rise : first;
      if (!(rise < most)) {
        break;
      }
      best.sharp_angle = radians(angle);
      best.cutoff.trials = {{last.cutoff, next}};
    }
    return first;
  }

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
  // Where the flow without creases may leave nothing, creases cannot be found to leave less.
  const double least =
      std::max(tuning.creases.least_risk * without.noise * without.noise, without.risk_error);
  if (!(without.best().risk > least)) {
    return std::nullopt;
  }
  const TrialMesh mesh(X, topology, fixed, keeping, search.enough);
  const CreaseSearch creases(mesh, without, search);
  CreaseChoice best = creases.with_first_angle();
  if (!creases.is_below(best, tuning.creases.some_share)) {
    return std::nullopt;
  }
  creases.try_other_angles(best);
  if (!creases.is_below(best, tuning.creases.clear_share) || !creases.is_no_chance(best)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ibmfair
