// The few bad spots that keep a step of the whole mesh from lowering the energy.
#pragma once

#include <vector>

#include "ibmfair/flow/flow_problem.h"

namespace ibmfair {

struct Culprits {
  std::vector<Index> vertices;  ///< of this part of the mesh
  bool are_local = false;       ///< there are some, and not so many that the trouble is everywhere
};

/// The vertices of the unknowns at which a move (one row per unknown) runs uphill against a
/// gradient where it leads, by more than a small share of the steepest such slope in any part of
/// the mesh; what is not a number is uphill, too.
Culprits find_culprits(const FlowProblem& problem, const Points& gradient, const Points& move);

}  // namespace ibmfair
