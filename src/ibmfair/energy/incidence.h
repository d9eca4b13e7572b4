// From vertices back to the places where stencils name them, so that sums per vertex are gathered
// in a fixed order instead of scattered: race-free, and the same bytes for any number of threads.
#pragma once

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// For every vertex the positions in `stencils.value` that hold it, in increasing order.
Rows places_by_vertex(const Rows& stencils, Index vertex_count);

}  // namespace ibmfair
