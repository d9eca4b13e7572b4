// The flow as published: [W07] section 3.2.
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Runs `options.steps` equal steps of `problem` with one factorization, even if the energy rises.
void run_plain(FlowProblem& problem, const StepObserver& observer);

}  // namespace ibmfair
