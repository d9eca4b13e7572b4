// Finds out which holes have to be filled together.
#pragma once

#include <vector>

#include "ibmfair/fill/holes.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Partitions the holes with the numbers `chosen` into groups. Holes belong to one group if they
/// share a vertex, or if free vertices around them (in `free_rings` rings of mesh vertices) share a
/// neighbour, because the energy of each then depends on the free vertices of the other, or if one
/// surrounds the other (`surrounding`, the result of surrounding_holes). Groups are ordered by
/// their first hole.
std::vector<std::vector<Index>> group_holes(const Topology& topology,
                                            const std::vector<Hole>& holes,
                                            const std::vector<Index>& chosen, int free_rings,
                                            const std::vector<Index>& surrounding);

}  // namespace ibmfair
