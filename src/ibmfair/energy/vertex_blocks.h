// The vertices of a mesh in blocks of neighbours. A block is small enough that the data which the
// energies keep for it stays in a core's cache.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The corners of the triangles that are `kept` (#F), each vertex in one block. If neighbours are
/// close together in the order of the input, the blocks are runs of this order; otherwise they grow
/// ring by ring. Linear in the size of the mesh.
CompressedRows vertex_blocks(const Topology& topology, const std::vector<std::uint8_t>& kept);

}  // namespace ibmfair
