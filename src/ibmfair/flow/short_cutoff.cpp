#include "ibmfair/flow/short_cutoff.h"

#include <cmath>

#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
std::optional<FlowOptions> short_cutoff_options(const Points& X, const Topology& topology,
                                                const FlowOptions& options,
                                                const MeshParts& parts) {
  if (!options.guarded) {
    return std::nullopt;
  }
  const double edge = mean_edge_length(X, topology, parts);
  const double enough = time_in_flow_units(time_for_cutoff(tuning.short_cutoff.enough * edge), X,
                                           topology, options, parts);
  constexpr double rounding = 1e-9;  // of times that were computed in different ways
  if (!(options.total_time < (1 - rounding) * enough)) {
    return std::nullopt;
  }
  const double cutoff = tuning.short_cutoff.enough * std::pow(options.total_time / enough, 0.25);
  FlowOptions gentle = options;
  gentle.relaxation *= std::pow(cutoff / tuning.short_cutoff.enough, 2);
  gentle.relax_along_creases = true;
  gentle.clean_up = options.clean_up && cutoff >= tuning.short_cutoff.clean_up;
  return gentle;
}

}  // namespace ibmfair
