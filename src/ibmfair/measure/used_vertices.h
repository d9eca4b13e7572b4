// The vertices that take part in a surface.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The vertices that occur in F (#F x 3), each once, in rising order.
std::vector<Index> used_vertices(const Triangles& F);

/// Their positions, one a row.
Points used_positions(const Points& X, const Triangles& F);

}  // namespace ibmfair
