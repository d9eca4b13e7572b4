// The flow linearised at a state, for heights over it: that of time T by n steps of backward Euler
// is (J^-1 D)^n with the Jacobian J of the step T / n.
#pragma once

#include "ibmfair/flow/flow_problem.h"

namespace ibmfair {

/// Makes the problem's Jacobian that of its state, for so many steps in that time. Throws what
/// Jacobian::refactor throws.
void linearise_flow(FlowProblem& problem, double time, int steps);

/// After that: what these steps make of up to three heights at each unknown, one a column.
void flow_linearly(FlowProblem& problem, int steps, Points& heights);

}  // namespace ibmfair
