// Carries out the plan of a run of `smooth`.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "commands/progress.h"
#include "commands/smooth_plan.h"

namespace ibmfair::commands {

/// Does what comes before the flow of the plan: fairs the lines in which sheets meet and the rims
/// of X (#V x 3), if the plan says so. Returns the vertices that are fixed in the flow (#V flags).
std::vector<std::uint8_t> prepare_for_flow(const SmoothPlan& plan, const Topology& topology,
                                           Points& X);

/// Prepares X (#V x 3) for the flow of the plan, and moves it by the flow, which ends after a step
/// at which `wants_end` is true. Throws like willmore_flow.
FlowReport run_smoothing(const SmoothPlan& plan, Points& X, const Topology& topology,
                         const MeshParts& parts, const std::function<bool()>& wants_end,
                         Progress& progress);

}  // namespace ibmfair::commands
