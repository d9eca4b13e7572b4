// The flow with the guard: every step is checked before it is taken.
#pragma once

#include "ibmfair/flow/flow_problem.h"

namespace ibmfair {

/// Runs `problem` for `options.total_time`. See willmore_flow.h for what it promises.
void run_guarded(FlowProblem& problem, const StepObserver& observer);

}  // namespace ibmfair
