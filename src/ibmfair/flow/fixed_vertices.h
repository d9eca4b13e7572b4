// The fixed vertices, which the flow does not move.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// What is fixed along an open boundary: positions and normals ([W07] section 3.2: two rings of
/// vertices), positions only, or nothing; then it moves along the surface's normals
/// (flow/steps/free_rims.h).
enum class BoundaryCondition : std::uint8_t { fixed, position, free };

/// Flags (#V) of the fixed vertices: along the boundary as `condition` says, at every defect (its
/// stencils carry no energy, so that no force would keep it in the surface), and isolated vertices.
std::vector<std::uint8_t> fixed_vertices(const Topology& topology, BoundaryCondition condition);

}  // namespace ibmfair
