// The loops of boundary edges.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Joins the edges of exactly one triangle end to end. At a bow-tie the walk stays within a fan, so
/// that loops which touch at a vertex are told apart. Ordered by smallest vertex, each loop
/// starting there and running so that its triangles lie to the left. Needs F, E, edge_triangles,
/// stars, kind.
std::vector<BoundaryLoop> find_boundary_loops(const Topology& topology);

}  // namespace ibmfair
