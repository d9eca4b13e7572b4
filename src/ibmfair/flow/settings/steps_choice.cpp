#include "ibmfair/flow/settings/steps_choice.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The share of the vertices that the flow moves further along the normals than `distance`.
double share_moved_beyond(double distance, const Points& X, const Topology& topology,
                          const std::vector<std::uint8_t>& fixed, const FlowOptions& options) {
  Points end = X;
  willmore_flow(end, topology, fixed, options);
  const Unknowns unknowns(fixed);
  const Eigen::VectorXd heights =
      heights_along(unknown_normals(end, topology, unknowns), end, X, unknowns);
  return static_cast<double>((heights.array().abs() > distance).count()) /
         static_cast<double>(std::max<Eigen::Index>(heights.size(), 1));
}

}  // namespace

StepsChoice choose_for_steps(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                             double step, double longest, const CutoffSearch& search) {
  const NoiseTuning& noise = choice_tuning.noise;
  FlowOptions trial = options;
  trial.keep_volume = trial.keep_area = false;
  const auto is_explained = [&](const StepsChoice& choice) {
    search.tell(choice.cutoff);
    trial.sharp_angle = choice.sharp_angle;
    trial.total_time = time_in_flow_units(time_for_cutoff(choice.cutoff), X, topology, trial);
    return share_moved_beyond(noise.largest_error * step, X, topology, fixed, trial) <=
           noise.beyond_error;
  };
  StepsChoice choice{.cutoff = longest};
  if (is_explained(choice)) {
    return choice;
  }
  choice.sharp_angle = noise.creases_of_steps;
  const double shortest =
      std::sqrt(2.0) * choice_tuning.cutoff.shortest * mean_edge_length(X, topology.E);
  while (!is_explained(choice) && choice.cutoff > shortest) {
    choice.cutoff /= std::sqrt(2.0);
  }
  return choice;
}

}  // namespace ibmfair
