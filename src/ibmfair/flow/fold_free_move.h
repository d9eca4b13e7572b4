// Moves of the flow's state that fold no hinge over.
#pragma once

#include <cstdint>
#include <functional>

#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/folds.h"

namespace ibmfair {

/// How a move ended that folds nothing over.
struct FoldFreeLanding {
  FlowProblem::Landing landing = FlowProblem::Landing::as_asked;
  std::int64_t withheld = 0;  ///< vertices
  double energy = 0;          ///< there

  bool leads_somewhere() const { return landing != FlowProblem::Landing::infeasible; }
};

/// Displaces the state of the problem into Y (FlowProblem::displace), withholding from `move` (one
/// row per unknown) the vertices whose hinges would fold over. `energy_at` is one of the problem's
/// functions: an energy that looks at hinges tells on its way whether any may have folded. Nowhere,
/// too, where folds remain all the same.
FoldFreeLanding displace_without_folds(const FlowProblem& problem, FoldWatch& folds, Points& move,
                                       Points& Y,
                                       const std::function<double(const Points&)>& energy_at);

}  // namespace ibmfair
