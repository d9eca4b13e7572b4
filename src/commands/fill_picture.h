// What the picture of a filled mesh looks at.
#pragma once

#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/picture/render.h"

namespace ibmfair::commands {

/// The view of the patch with the largest area, from outside. `X`, `topology`: the filled mesh.
/// The default options if there is no patch.
RenderOptions view_of_largest_patch(const Filling& filling, const Points& X,
                                    const Topology& topology);

}  // namespace ibmfair::commands
