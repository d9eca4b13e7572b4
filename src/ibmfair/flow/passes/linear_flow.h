// The flow linearised at a state, for heights over this state. In n steps of backward Euler, the
// linearised flow of time T is (J^-1 D)^n, with J the Jacobian of the time step T / n.
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Renews the problem's Jacobian at its state, for the time step time / steps. Systems are solved
/// to the relative residual `tolerance`, or better. Throws the exceptions of Jacobian::refactor.
void linearise_flow(FlowProblem& problem, double time, int steps, double tolerance);

/// Applies the linearised flow to `heights`: one row per unknown, up to three sets of heights in
/// the columns. Precondition: `linearise_flow` was called with the same number of steps.
void flow_linearly(FlowProblem& problem, int steps, Points& heights);

}  // namespace ibmfair
