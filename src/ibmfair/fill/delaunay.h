// Makes the triangulation of a patch intrinsically Delaunay by flipping edges.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// Flips edges whose opposite angles add up to more than pi until none are left. An edge is not
/// flipped if the new edge exists already, or if the flip would fold the surface over. Returns the
/// number of flips.
Index flip_to_delaunay(Patch& patch);

}  // namespace ibmfair
