// Fewer triangles for a mesh that is too large to be turned about on a screen.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// About `most` triangles over some of the vertices that F has, which stay where they are; F where
/// it has no more. Edges of a single triangle stay, so that parts which are decimated one by one
/// still meet, unless the mesh has so many of them that hardly anything could go. For viewing only:
/// distances are measured in single precision about the centre of the bounding box (by
/// meshoptimizer).
Triangles decimate(const Points& X, const Triangles& F, Index most);

}  // namespace ibmfair
