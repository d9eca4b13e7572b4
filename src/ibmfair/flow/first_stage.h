// What a flow that keeps sharp hinges does first: where there is much noise, only those of right
// angles or nearly so hold, up to a short cut-off. Spikes that noise has made are as sharp as
// creases, and would stay; no hinge that is left after them is sharp by chance. A. Blake and A.
// Zisserman, "Visual Reconstruction" (1987), call it graduated non-convexity.
#pragma once

#include <optional>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The options of that stage, which has a time of its own, of a quarter of theirs at most; none
/// where hinges turn by little, or all may bend.
std::optional<FlowOptions> first_stage(const Points& X, const Topology& topology,
                                       const FlowOptions& options, const MeshParts& parts);

}  // namespace ibmfair
