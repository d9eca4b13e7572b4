// From vertices back to the places where stencils name them, so that sums per vertex are gathered
// in a fixed order instead of scattered: race-free, and the same bytes for any number of threads.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// For every vertex the positions in `stencils.value` that hold it, in increasing order.
Rows places_by_vertex(const Rows& stencils, Index vertex_count);

/// G.row(v) = the sum of the vectors at the places of v; #V x 3. Every stencil has K places.
template <std::size_t K>
void gather(const Rows& places, const std::vector<std::array<Vec3, K>>& at_places, Points& G) {
  G.resize(places.size(), 3);
  parallel_for(places.size(), [&](std::int64_t v) {
    Vec3 sum = Vec3::Zero();
    for (const Index place : places[static_cast<Index>(v)]) {
      sum += at_places[static_cast<std::size_t>(place) / K][static_cast<std::size_t>(place) % K];
    }
    G.row(v) = sum;
  });
}

}  // namespace ibmfair
