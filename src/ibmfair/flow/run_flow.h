// The parts of a flow, for callers that run them one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Throws BadOption or BadMesh if a flow cannot start at `X` (flow/willmore_flow.h).
void require_usable(const Points& X, const std::vector<std::uint8_t>& fixed,
                    const FlowOptions& options, const MeshParts& parts);

/// Runs the first stage of the flow (flow/first_stage.h), if it has one, from the problem's start.
/// Moves the problem to the result unless that raises its energy. Returns the report of the stage.
/// If the observer asks to stop, the problem's status is `interrupted`.
FlowReport run_first_stage(FlowProblem& problem, const std::vector<std::uint8_t>& fixed,
                           const StepObserver& observer = {});

/// Lets the problem's state flow for `options.total_time`, guarded (and then cleaned up) or as
/// published.
void run_flow(FlowProblem& problem, const StepObserver& observer = {});

}  // namespace ibmfair
