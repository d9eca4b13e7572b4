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
  CreaseSearch(const TrialMesh& mesh, const FlowOptions& bending, const CutoffChoice& without,
               const CutoffSearch& search)
      : mesh_(mesh), without_(without), search_(search), estimate_(mesh, without.noise) {
    FlowOptions options = mesh.options();  // with the lists of the sample
    options.laplacian = bending.laplacian;
    options.twicing = bending.twicing;
    options.relax = bending.relax;
    bending_risk_ = estimate_.risk(options, without.cutoff);
  }

  /// Whether a choice leaves less than this share of the risk without creases, and the difference
  /// is no chance.
  bool is_below(const CreaseChoice& choice, double share) const {
    const double risk = choice.cutoff.best().risk;
    const double chance = tuning.creases.chance * without_.noise * without_.noise /
                          std::sqrt(static_cast<double>(estimate_.counted()));
    return risk < share * bending_risk_ && risk < bending_risk_ - chance;
  }

  /// The best cut-off for an angle (degrees), from `start` (length).
  CreaseChoice with_angle(double angle, double start) const {
    CreaseChoice choice{radians(angle), without_};
    // Creases allow longer cut-offs than without.
    choice.cutoff.trials = trials_around([&](double cutoff) { return risk(angle, cutoff); },
                                         {.start = start,
                                          .shortest = without_.cutoff / std::sqrt(2.0),
                                          .largest = search_.largest,
                                          .hopeless = bending_risk_});
    choice.cutoff.cutoff = cutoff_of_least_risk(choice.cutoff.trials, true);
    return choice;
  }

  /// Goes on to the angles (degrees) as long as each reduces the risk clearly.
  template <class Angles>
  void go_on(const Angles& angles, CreaseChoice& best) const {
    const double gain = tuning.creases.clear_gain * without_.noise * without_.noise;
    for (const double angle : angles) {
      const CutoffTrial last = best.cutoff.best();
      if (!(last.risk - risk(angle, last.cutoff) > gain)) {
        return;
      }
      best = with_angle(angle, last.cutoff);
    }
  }

 private:
  double risk(double angle, double cutoff) const {
    if (search_.observer) {
      search_.observer(cutoff);
    }
    FlowOptions options = mesh_.options();
    options.sharp_angle = radians(angle);
    return estimate_.risk(options, cutoff);
  }

  const TrialMesh& mesh_;
  const CutoffChoice& without_;
  const CutoffSearch& search_;
  const AddedNoise estimate_;
  double bending_risk_ = 0;
};

}  // namespace

std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& fixed,
                                           const FlowOptions& bending, const FlowOptions& keeping,
                                           const CutoffChoice& without,
                                           const CutoffSearch& search) {
  const double variance = without.noise * without.noise;
  if (!(without.best().risk > tuning.creases.least_risk * variance)) {
    return std::nullopt;
  }
  const TrialMesh mesh(X, topology, fixed, keeping, search.enough);
  const CreaseSearch creases(mesh, bending, without, search);
  CreaseChoice best = creases.with_angle(tuning.creases.first_angle,
                                         tuning.creases.first_cutoff * mesh.mean_edge_length());
  if (!creases.is_below(best, tuning.creases.some_share)) {
    return std::nullopt;
  }
  const double first = best.sharp_angle;
  creases.go_on(tuning.creases.sharper_angles, best);
  if (best.sharp_angle == first) {
    creases.go_on(tuning.creases.blunter_angles, best);
  }
  if (!creases.is_below(best, tuning.creases.clear_share)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ibmfair
