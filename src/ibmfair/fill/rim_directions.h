// Directions at the rim of a hole that do not follow every roughness of the mesh.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// Moves the second ring of the patch's surroundings, from which the patch takes its directions, to
/// where smooth surfaces through a wider band of the mesh would have it. A robust quadratic surface
/// is fitted to the vertices around each vertex of this ring. The vertex gets the offset from the
/// surface that its neighbours on the rim have. Vertices on the rim stay in place.
void smooth_directions(const Points& X, const Topology& topology, Patch& patch);

}  // namespace ibmfair
