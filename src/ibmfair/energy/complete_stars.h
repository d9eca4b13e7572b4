// The stencils of the cotangent Laplacian.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// For every interior vertex whose triangles may all carry a stencil: the vertex, then its
/// neighbours in the cyclic order of the triangles around it. Triangle k lies between neighbours k
/// and k + 1, and the last triangle between the last and the first neighbour. With `active` (#V, or
/// empty for all), only the stars that contain a vertex marked true.
CompressedRows complete_stars(const Topology& topology, const std::vector<std::uint8_t>& active);

}  // namespace ibmfair
