// A flow of a mesh with its open boundaries fixed, or as they are told.
#pragma once

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "support/states.h"

namespace ibmfair::test {

struct FlowRun {
  Points X;
  FlowReport report;
};

/// Runs a flow whose cut-off is given in mean edge lengths.
inline FlowRun run_flow(const State& state, double cutoff, FlowOptions options,
                        BoundaryCondition boundary = BoundaryCondition::fixed) {
  const double time = time_for_cutoff(cutoff * mean_edge_length(state.X, state.topology.E));
  options.total_time = time_in_flow_units(time, state.X, state.topology, options);
  FlowRun result{state.X, {}};
  result.report =
      willmore_flow(result.X, state.topology, fixed_vertices(state.topology, boundary), options);
  return result;
}

}  // namespace ibmfair::test
