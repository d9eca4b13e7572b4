// Uphill vertices: the few vertices that raise the energy, and so keep a step of the whole mesh
// from lowering it.
#pragma once

#include <vector>

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

struct UphillVertices {
  std::vector<Index> vertices;  ///< the uphill vertices in this part of the mesh
  bool are_local = false;       ///< there are some, and they are a small share of all unknowns
};

/// The vertices at which a move (one row per unknown) raises the energy: its product with
/// `gradient`, the gradient at the end of the move, exceeds a small share of the largest such
/// product in any part of the mesh, or is NaN.
UphillVertices find_uphill_vertices(const FlowProblem& problem, const Points& gradient,
                                    const Points& move);

}  // namespace ibmfair
