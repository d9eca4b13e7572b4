// Which holes have to be filled together.
#pragma once

#include <vector>

#include "ibmfair/fill/holes.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Partitions the holes with numbers `chosen`: those that share a vertex, or whose `free_rings`
/// rings of free vertices outside are neighbours, come together, as one's energy has the other's
/// vertices in it. Groups are ordered by their first hole.
std::vector<std::vector<Index>> group_holes(const Topology& topology,
                                            const std::vector<Hole>& holes,
                                            const std::vector<Index>& chosen, int free_rings);

}  // namespace ibmfair
