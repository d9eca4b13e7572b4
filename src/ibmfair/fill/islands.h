// Islands: pieces of a mesh that lie inside a hole of another piece.
#pragma once

#include <vector>

#include "ibmfair/fill/holes.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// For each hole, the hole that surrounds it, or -1. A hole is surrounded if it is the longest loop
/// of its component, and if this component lies inside the other hole, facing the same side, and
/// near the surface that the mesh around the other hole suggests. A hole that surrounds several
/// islands, or is surrounded itself, surrounds none for this purpose.
std::vector<Index> surrounding_holes(const Points& X, const Topology& topology,
                                     const std::vector<Hole>& holes);

}  // namespace ibmfair
