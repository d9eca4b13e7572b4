// Finds what noise has folded over for good: a flap of a few triangles that lies on its back costs
// a curvature energy less than the way out would, and the sweeps of tangential relaxation hold it
// only in balance.
#pragma once

#include <numbers>

#include "ibmfair/flow/patch_flow.h"

namespace ibmfair {

/// The largest dihedral angle, in radians, of the hinges that find_flaps looks at.
inline constexpr double fold_to_undo = std::numbers::pi / 3;

/// Vertices of hinges that are folded over, though the surface around is nearly flat, and the
/// neighbours of these, in patches. Sharp edges, the rims of sheets and thin tips are not among
/// them, as what is around them is not flat; nor is what is at a boundary or on several parts.
/// `flat`: what the normals around keep of their lengths when they are added, at least, up to 1.
/// `rings` are those of vertex_rings.
std::vector<VertexPatch> find_flaps(const Points& X, const Topology& topology, const Rows& rings,
                                    const Unknowns& unknowns, const MeshParts& parts, double flat);

/// Whether the triangles around a patch that it does not move are so flat.
bool is_flat_around(const VertexPatch& patch, const Points& X, const Topology& topology,
                    const Rows& rings, double flat);

/// Brings each vertex of a patch to the mean of its neighbours: a map that folds nothing over where
/// the rim is convex (Tutte 1963).
void even_out(const VertexPatch& patch, const Rows& rings, Points& X);

}  // namespace ibmfair
