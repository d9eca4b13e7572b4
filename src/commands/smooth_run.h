// Carries out the plan of a run of `smooth`.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "commands/progress.h"
#include "commands/smooth_plan.h"

namespace ibmfair::commands {

/// Fairs the lines of X (#V x 3) in which sheets meet and its rims, if the plan says so, as comes
/// before the flow. Returns the vertices that are fixed in the flow (#V flags).
std::vector<std::uint8_t> prepare_for_flow(const SmoothPlan& plan, const Topology& topology,
                                           Points& X);

/// Moves the outliers of X (#V x 3), prepares it, and moves it by the flow of the plan, which ends
/// after a step at which `wants_end` is true. If the plan has no steps, only outliers move. Throws
/// like willmore_flow.
FlowReport run_smoothing(const SmoothPlan& plan, Points& X, const Topology& topology,
                         const MeshParts& parts, const std::function<bool()>& wants_end,
                         Progress& progress);

}  // namespace ibmfair::commands
