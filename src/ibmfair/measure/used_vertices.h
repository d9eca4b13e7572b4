// The vertices that are used by the triangles of a surface.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The vertices that occur in F (#F x 3), each once, in increasing order.
std::vector<Index> used_vertices(const Triangles& F);

/// The positions of these vertices, one per row.
Points used_positions(const Points& X, const Triangles& F);

}  // namespace ibmfair
