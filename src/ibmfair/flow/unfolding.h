// Takes out what noise has folded over for good: a flap of a few triangles that lies on its back
// costs a curvature energy less than the way out would, and the sweeps of tangential relaxation
// hold it only in balance.
#pragma once

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Where hinges are folded over, though the surface around is nearly flat, the moves that bring
/// their vertices and the neighbours of these to where each is at the mean of its own neighbours (a
/// map that folds nothing over where the rim is convex: Tutte 1963): one row per unknown, length,
/// zero elsewhere. Sharp edges, the rims of sheets and thin tips stay, as what is around them is
/// not flat; so does what is at a boundary or on several parts. `rings` are those of vertex_rings.
/// False, and nothing done, where no part of the mesh has anything to unfold.
bool unfolding_moves(const Points& X, const Topology& topology, const Rows& rings,
                     const Unknowns& unknowns, const MeshParts& parts, Points& move);

}  // namespace ibmfair
