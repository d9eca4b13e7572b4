// Finds the boundary loops of a mesh.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Joins the boundary edges (edges of exactly one triangle) end to end. At a bow-tie vertex the
/// walk stays within one fan, so loops that touch at a vertex are kept apart. The loops are ordered
/// by their smallest vertex. A closed loop starts at its smallest vertex and, on an orientable
/// mesh, has its triangles on the left. Needs F, E, edge_triangles, stars and kind of `topology`.
std::vector<BoundaryLoop> find_boundary_loops(const Topology& topology);

}  // namespace ibmfair
