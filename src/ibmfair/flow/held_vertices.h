// Which vertices the flow may not move.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// What is kept along an open boundary: positions and normals ([W07] section 3.2: two rings of
/// vertices), positions only, or nothing.
enum class BoundaryCondition : std::uint8_t { fixed, position, free };

/// #V, true for vertices that are held: along the boundary as `condition` says, at every defect
/// (its stencils carry no energy, so nothing would hold it in the surface), and isolated ones.
std::vector<std::uint8_t> held_vertices(const Topology& topology, BoundaryCondition condition);

}  // namespace ibmfair
