// Makes the triangulation of a patch intrinsically Delaunay by flipping edges.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// Flips edges whose opposite angles add up to more than pi, until there are none. An edge stays
/// where its other diagonal exists already, or where flipping would fold the surface. Returns the
/// number of flips.
Index flip_to_delaunay(Patch& patch);

}  // namespace ibmfair
