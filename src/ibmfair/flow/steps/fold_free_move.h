// Moves of the flow's state that are foldover-free: they fold no hinge (edge with its two
// triangles) over.
#pragma once

#include <cstdint>
#include <functional>

#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/folds.h"

namespace ibmfair {

/// The result of a foldover-free move.
struct FoldFreeLanding {
  FlowProblem::Landing landing = FlowProblem::Landing::complete;
  std::int64_t withheld = 0;  ///< vertices that were not moved, to avoid foldovers
  double energy = 0;          ///< at the end of the move

  bool is_feasible() const { return landing != FlowProblem::Landing::infeasible; }
};

/// Writes the state displaced by `move` (one row per unknown) to Y (FlowProblem::displace). The
/// rows of `move` for vertices whose hinges would fold over are set to zero. If foldovers remain
/// after several attempts, the landing is infeasible. `energy_at` must evaluate the energy of the
/// problem: energies that use hinges also tell whether any hinge may have folded over.
FoldFreeLanding displace_without_folds(const FlowProblem& problem, const FoldWatch& folds,
                                       Points& move, Points& Y,
                                       const std::function<double(const Points&)>& energy_at);

}  // namespace ibmfair
