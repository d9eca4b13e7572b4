// The parts of a flow, for those that want them one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/flow_problem.h"

namespace ibmfair {

/// Throws BadOption or BadMesh where a flow from `X` cannot begin (flow/willmore_flow.h).
void require_usable(const Points& X, const std::vector<std::uint8_t>& held,
                    const FlowOptions& options, const MeshParts& parts);

/// Moves a problem that is at its start to where the first stage of its flow leads
/// (flow/first_stage.h), where it has one, unless that is uphill. Returns what that took. Where the
/// observer asks to stop, the problem's status says so.
FlowReport run_first_stage(FlowProblem& problem, const std::vector<std::uint8_t>& held,
                           const StepObserver& observer = {});

/// Lets the problem's state flow for `options.total_time`, guarded or as published.
void run_flow(FlowProblem& problem, const StepObserver& observer = {});

}  // namespace ibmfair
