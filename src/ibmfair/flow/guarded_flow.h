// The flow with the guard: every step is checked before it is taken.
#pragma once

#include "ibmfair/flow/flow_problem.h"

namespace ibmfair {

/// Runs `problem` for `options.total_time`. willmore_flow.h lists the promises of the guarded flow.
void run_guarded(FlowProblem& problem, const StepObserver& observer);

}  // namespace ibmfair
