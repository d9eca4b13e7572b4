// The first stage of a flow that keeps sharp hinges (edges with their two triangles). On a noisy
// mesh, this stage smooths up to a short cut-off and keeps only hinges that turn by 60 degrees or
// more. Without it, spikes made by noise, which are as sharp as creases, would stay; after it,
// hardly any hinge is sharp by chance. A. Blake and A. Zisserman, "Visual Reconstruction" (1987),
// call this method graduated non-convexity. Where the noise is so strong that the short flow rounds
// the creases as well, a guided filter of normals takes its place if the options ask for it.
#pragma once

#include <optional>

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// The options of the first stage of a flow from the problem's start. The time of the stage comes
/// on top of the time of the flow and is at most a part of it (FirstStageTuning::most_time).
/// Returns nothing if the mesh has little noise (its hinges turn by little on the mean), or if the
/// flow keeps no sharp hinges.
std::optional<FlowOptions> first_stage_options(const FlowProblem& problem);

/// The positions, #V x 3, of the mesh at `X` (#V x 3) with filtered normals: vertices that are not
/// `fixed` (#V flags) move so that the triangles get the normals of a guided filter
/// (mesh/guided_normals.h).
Points with_filtered_normals(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed);

/// The stage by normals (FirstStage::normals), from the start of a stage's problem: filters the
/// normals of the triangles, and moves the vertices so that the triangles get these normals. Strong
/// noise may fold hinges over; the flow unfolds them: without the moves that fold, a cube with
/// noise of 0.5 edges ends at 7.0 degrees off the true normals instead of 2.5. Volume and area are
/// not kept.
void filter_normals(FlowProblem& stage);

}  // namespace ibmfair
