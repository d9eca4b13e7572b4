// Normals of the vertices that move.
#pragma once

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Area-weighted normals of the unknown vertices, one row each: unit length, or zero where there is
/// none.
Points unknown_normals(const Points& X, const Topology& topology, const Unknowns& unknowns);

}  // namespace ibmfair
