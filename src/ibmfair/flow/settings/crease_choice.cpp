#include "ibmfair/flow/settings/crease_choice.h"

#include <utility>

#include "ibmfair/base/angle.h"

namespace ibmfair {
namespace {

/// Sharp angles to try, degrees. With less noise, a smaller angle keeps blunter creases.
constexpr double first_angle = 20, blunter_angles[] = {14, 10, 7};
/// The least decrease of the risk for a smaller angle to be taken, in variances of the noise.
constexpr double clear_gain = 0.008;
/// Creases are kept if the risk with creases is below this share of the risk without. On mechanical
/// parts with creases the share is at most 0.12, for noise of 0.05 to 0.3 edges. On scans it is 0.5
/// or more: they gain little, and keeping creases would change them more than necessary.
constexpr double clear_share = 0.4;
constexpr double some_share = 0.8;  // smaller angles are tried if the first is below this share
constexpr double crease_edges = 4;  // first cut-off in edges: at shorter ones, noise makes creases
/// No creases are looked for if the risk without them is below this, in variances of the noise.
constexpr double least_risk = 0.06;

}  // namespace

std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& fixed,
                                           const FlowOptions& options, const CutoffChoice& without,
                                           const CutoffSearch& search) {
  const double before = without.best().risk, variance = without.noise * without.noise;
  if (!(before > least_risk * variance)) {
    return std::nullopt;
  }
  CutoffSearch same_noise = search;
  same_noise.noise = without.noise;
  CutoffChooser chooser(X, topology, fixed, options, same_noise);
  const auto with_angle = [&](double angle, double shortest) {
    return CreaseChoice{radians(angle), chooser.choose(radians(angle), shortest)};
  };
  CreaseChoice best = with_angle(first_angle, crease_edges * chooser.mean_edge_length());
  if (!(best.cutoff.best().risk < some_share * before)) {
    return std::nullopt;
  }
  for (const double angle : blunter_angles) {
    // A smaller angle keeps more of the hinges made by noise, and a longer flow removes them.
    CreaseChoice blunter = with_angle(angle, best.cutoff.before_best());
    if (!(best.cutoff.best().risk - blunter.cutoff.best().risk > clear_gain * variance)) {
      break;
    }
    best = std::move(blunter);
  }
  if (!(best.cutoff.best().risk < clear_share * before)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ibmfair
