#include "ibmfair/flow/settings/laplacian_choice.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/flow/settings/added_noise.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/trial_mesh.h"

namespace ibmfair {

std::optional<CutoffChoice> choose_laplacian(const Points& X, const Topology& topology,
                                             const std::vector<std::uint8_t>& fixed,
                                             const FlowOptions& first, const FlowOptions& other,
                                             const CutoffChoice& choice,
                                             const CutoffSearch& search) {
  const TrialMesh mesh(X, topology, fixed, other,
                       {std::min(search.sample.vertices, choice_tuning.laplacian.sample),
                        choice_tuning.laplacian.felt_rings});
  const double variance = choice.noise.variance();
  const double start = choice_tuning.laplacian.first_cutoff * choice.cutoff;
  const AddedNoise added(mesh, choice.noise, mesh.options(), start);
  const auto trial = [&](NoisierFlows& flows, double cutoff) {
    search.tell(cutoff);
    return flows.trial(cutoff);
  };
  NoisierFlows flows(added, mesh.options());
  CutoffChoice best = choice;
  best.trials = {trial(flows, start)};
  if (best.best().risk > choice.best().risk + choice_tuning.laplacian.hopeless * variance) {
    return std::nullopt;
  }
  NoisierFlows first_flows(added, mesh.here(first));
  const double risk_of_first = trial(first_flows, choice.cutoff).risk;
  if (best.best().risk > risk_of_first + choice_tuning.laplacian.worse_start * variance) {
    return std::nullopt;
  }
  best.trials = trials_around(
      [&](double cutoff) { return cutoff == start ? best.trials.front() : trial(flows, cutoff); },
      {.start = start, .shortest = start / std::sqrt(2.0), .largest = search.largest});
  best.cutoff = cutoff_of_least_risk(best.trials, false);
  const double chance =
      choice_tuning.laplacian.chance * variance / std::sqrt(static_cast<double>(added.counted()));
  if (!(best.best().risk < risk_of_first - chance)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace ibmfair
