// What noise leaves of a flow that keeps creases: where it was strongest, a few hinges turn
// sharply, and hold.
#pragma once

#include "ibmfair/flow/patch_flow.h"

namespace ibmfair {

/// Vertices of hinges that are held in part at least by `sharp_angle` (radians), in patches, where
/// these are few, meet or go round, and all around them is nearly flat: a crease is a line, and a
/// long one. `rings` are those of vertex_rings.
std::vector<VertexPatch> find_specks(const Points& X, const Topology& topology, const Rows& rings,
                                     const Unknowns& unknowns, const MeshParts& parts,
                                     double sharp_angle);

/// Evens them out at the end of a problem's flow by its own sharp angle, and lets them flow anew
/// with what is around them. For meshes that were noisy: without noise, a speck is a detail. As the
/// guarded flow promises, the energy does not rise, and no hinge folds over.
void flatten_specks(FlowProblem& problem);

}  // namespace ibmfair
