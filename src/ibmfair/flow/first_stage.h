// The first stage of a flow that keeps sharp hinges (edges with their two triangles). On a noisy
// mesh, this stage smooths up to a short cut-off and keeps only hinges that turn by 60 degrees or
// more. Without it, spikes made by noise, which are as sharp as creases, would stay; after it,
// hardly any hinge is sharp by chance. A. Blake and A. Zisserman, "Visual Reconstruction" (1987),
// call this method graduated non-convexity.
#pragma once

#include <optional>

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// The options of the first stage of a flow from the problem's start. The time of the stage comes
/// on top of the time of the flow and is at most a part of it (FirstStageTuning::most_time).
/// Returns nothing if the mesh has little noise (its hinges turn by little on the mean), or if the
/// flow keeps no sharp hinges.
std::optional<FlowOptions> first_stage_options(const FlowProblem& problem);

}  // namespace ibmfair
