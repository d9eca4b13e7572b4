// The passes of a flow, one after another. Each takes the state from the pass before.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Throws BadOption or BadMesh if a flow cannot start at `X` (flow/willmore_flow.h).
void require_usable(const Points& X, const std::vector<std::uint8_t>& fixed,
                    const FlowOptions& options, const MeshParts& parts = MeshParts::one());

/// Runs all passes of a flow from the problem's start. Precondition: there are unknowns.
void run_passes(FlowProblem& problem, const StepObserver& observer = {});

// The first two passes, for trials of settings (flow/settings/cutoff_trials.h).

/// Runs the first stage of the flow (flow/first_stage.h), if it has one, from the problem's start.
/// Moves the problem to the result unless that raises its energy. Returns the report of the stage,
/// or nothing if there is none. If the observer asks to stop, the problem's status is
/// `interrupted`. `rings`: the result of vertex_rings.
std::optional<FlowReport> run_first_stage(FlowProblem& problem, const CompressedRows& rings,
                                          const StepObserver& observer = {});

/// Takes the problem's state through `options.total_time`, guarded (and then cleaned up) or as
/// published. `rings`: the result of vertex_rings.
void run_time_steps(FlowProblem& problem, const CompressedRows& rings,
                    const StepObserver& observer = {});

}  // namespace ibmfair
