// Looks at a part of a mesh instead of the whole mesh.
#pragma once

#include "ibmfair/mesh/topology.h"
#include "ibmfair/picture/render.h"

namespace ibmfair {

/// The options with the view straight onto the `count` triangles of `topology.F` from number
/// `first` on, from the side of their mean normal, and with a frame around these triangles and
/// their surroundings. In a closed component whose triangles are oriented inward, the view comes
/// from outside nevertheless. The mean normal of a tube is about zero: the view then comes from the
/// side nearest to `options.view.from`. Parts of the mesh that hide most of the triangles are left
/// out. Unchanged if the triangles have no area.
RenderOptions close_up(const Points& X, const Topology& topology, Index first, Index count,
                       RenderOptions options = {});

}  // namespace ibmfair
