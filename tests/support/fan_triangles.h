// The triangles that are listed by groups of fans.
#pragma once

#include "ibmfair/energy/mesh_blocks.h"
#include "ibmfair/energy/triangle_fans.h"

namespace ibmfair::test {

/// The triangles of one group, fan by fan, as the numbers of their corners.
inline CornerTriples triangles_of(const FanGroup& group, const std::vector<Index>& places,
                                  Index place_of_vertex) {
  CornerTriples triangles;
  for (Index fan = 0; fan < fans_per_group; ++fan) {
    const auto vertex = [&](std::int64_t row) {
      return places[group.first_place + fans_per_group * row + fan] / place_of_vertex;
    };
    for (Index i = 0; i < group.triangles; ++i) {
      triangles.push_back({vertex(0), vertex(i + 1), vertex(i + 2)});
    }
  }
  return triangles;
}

}  // namespace ibmfair::test
