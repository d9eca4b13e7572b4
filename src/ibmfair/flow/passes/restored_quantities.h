// The volume and the area that the steps of a flow did not keep (FlowOptions::put_back_slides).
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Restores the suspended volume and area at the end of a flow. If that folds a hinge over or
/// leaves more energy than at the start, the result is the start, and the flow has stalled.
/// Precondition: Jacobian::refactor was called.
void restore_quantities(FlowProblem& problem);

}  // namespace ibmfair
