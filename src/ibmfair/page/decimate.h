// Reduces the triangles of a mesh that is too large for interactive viewing.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// About `most` triangles on a subset of the vertices of F, which are not moved; F itself if it has
/// no more than `most` triangles. Boundary edges are kept, so that parts which are decimated
/// separately still meet, unless there are so many boundary edges that hardly any triangle could be
/// removed. For viewing only: meshoptimizer measures distances in single precision about the centre
/// of the bounding box.
Triangles decimate(const Points& X, const Triangles& F, Index most);

}  // namespace ibmfair
