#include "ibmfair/flow/crease_choice.h"

#include <utility>

#include "ibmfair/base/angle.h"

namespace ibmfair {
namespace {

/// Of sharp hinges, degrees: with less noise a smaller one keeps blunter creases.
constexpr double first_angle = 20, blunter_angles[] = {14, 10, 7};
constexpr double clear_gain = 0.008;  // of risk by a smaller one, in variances of the noise
/// Of the risk without creases: on parts with creases, next to nothing is left by those that keep
/// them (0.12 of it at most, by noise of 0.05 to 0.3 edges); scans have little to gain (0.5 or more
/// is left), and are changed more than need be.
constexpr double clear_share = 0.4;
constexpr double some_share = 0.8;   // by the first angle, to go on
constexpr double crease_edges = 4;   // of the first cut-off: with less, noise makes creases
constexpr double least_risk = 0.06;  // without creases, in variances of the noise: else all is well

}  // namespace

std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& held,
                                           const FlowOptions& options, const CutoffChoice& without,
                                           const CutoffSearch& search) {
  const double before = without.best().risk, variance = without.noise * without.noise;
  if (!(before > least_risk * variance)) {
    return std::nullopt;
  }
  CutoffSearch same_noise = search;
  same_noise.noise = without.noise;
  CutoffChooser chooser(X, topology, held, options, same_noise);
  const auto with_angle = [&](double angle, double shortest) {
    return CreaseChoice{radians(angle), chooser.choose(radians(angle), shortest)};
  };
  CreaseChoice best = with_angle(first_angle, crease_edges * chooser.mean_edge_length());
  if (!(best.cutoff.best().risk < some_share * before)) {
    return std::nullopt;
  }
  for (const double angle : blunter_angles) {
    // Where more of the noise's hinges hold, it takes a longer flow to be rid of them.
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
