// Moves of the flow's state that fold no hinge over.
#pragma once

#include <cstdint>

#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/folds.h"

namespace ibmfair {

/// Displaces the state of the problem into Y (FlowProblem::displace), withholding from `move` (one
/// row per unknown) the vertices whose hinges would fold over; their number is added to `withheld`.
/// Nowhere, too, where folds remain all the same.
FlowProblem::Landing displace_without_folds(const FlowProblem& problem, FoldWatch& folds,
                                            Points& move, Points& Y, std::int64_t& withheld);

}  // namespace ibmfair
