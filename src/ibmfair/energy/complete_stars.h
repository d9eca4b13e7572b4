// The stencils of the cotangent Laplacian.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// For every interior vertex all of whose triangles may carry a stencil: the vertex, then its
/// neighbours in the order in which its triangles follow each other around it, so that triangle k
/// has neighbours k and k + 1, the last one the last and the first. With `active` (#V, or empty for
/// all) only stars that have a true vertex.
Rows complete_stars(const Topology& topology, const std::vector<std::uint8_t>& active);

}  // namespace ibmfair
