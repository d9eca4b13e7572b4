// A mesh's vertices in blocks of neighbours, small enough for all that the energies keep of one
// block to stay in a core's cache.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The corners of the triangles that are `kept` (#F), each vertex in one block. Where the order of
/// the input has neighbours close together, blocks are runs of it; elsewhere they grow ring by
/// ring. Linear in the size of the mesh.
Rows vertex_blocks(const Topology& topology, const std::vector<std::uint8_t>& kept);

}  // namespace ibmfair
