// The flow as published: [W07] section 3.2.
#pragma once

#include <optional>

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Runs `options.steps` equal steps of `problem` with one factorization, even if the energy rises.
void run_plain(FlowProblem& problem, const StepObserver& observer);

/// Makes one step from the state with the Jacobian as it is, and adds it to the report. If the
/// energy would no longer be finite, the state stays, and there is no record. Precondition:
/// Jacobian::refactor was called.
std::optional<StepRecord> plain_step(FlowProblem& problem);

}  // namespace ibmfair
