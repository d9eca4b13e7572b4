#include "ibmfair/flow/settings/crease_choice.h"

#include <utility>

#include "ibmfair/base/angle.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {

std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& fixed,
                                           const FlowOptions& options, const CutoffChoice& without,
                                           const CutoffSearch& search) {
  const double before = without.best().risk, variance = without.noise * without.noise;
  if (!(before > tuning.creases.least_risk * variance)) {
    return std::nullopt;
  }
  CutoffSearch same_noise = search;
  same_noise.noise = without.noise;
  CutoffChooser chooser(X, topology, fixed, options, same_noise);
  const auto with_angle = [&](double angle, double shortest) {
    CreaseChoice choice{radians(angle), chooser.choose(radians(angle), shortest)};
    choice.cutoff.kind = without.kind;
    return choice;
  };
  CreaseChoice best =
      with_angle(tuning.creases.first_angle, tuning.creases.edges * chooser.mean_edge_length());
  if (!(best.cutoff.best().risk < tuning.creases.some_share * before)) {
    return std::nullopt;
  }
  for (const double angle : tuning.creases.blunter_angles) {
    // A smaller angle keeps more of the hinges made by noise, and a longer flow removes them.
    CreaseChoice blunter = with_angle(angle, best.cutoff.before_best());
    if (!(best.cutoff.best().risk - blunter.cutoff.best().risk >
          tuning.creases.clear_gain * variance)) {
      break;
    }
    best = std::move(blunter);
  }
  if (!(best.cutoff.best().risk < tuning.creases.clear_share * before)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ibmfair
