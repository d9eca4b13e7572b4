// Vertices with rings of the same length in groups of four, side by side, for the kernels that go
// round the vertices of a mesh in each step of a flow (flow/ring_kernels.h): vertex by vertex they
// would take two to three times as long.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Vertices in a group: as many as a kernel takes at a time (base/lanes.h).
inline constexpr Index rings_per_group = 4;

/// Groups in a part, at most.
inline constexpr std::int64_t groups_per_part = 32;

struct RingGroup {
  Index length = 0;  ///< of each of the rings
  Index count = 0;   ///< of vertices; the group is filled up with the first of them
};

struct RingGroups {
  /// Of the unknowns' vertices and their neighbours. Refers to `rings`, those of vertex_rings.
  RingGroups(const Topology& topology, const Rows& rings, const Unknowns& unknowns);

  const Rows& rings;
  std::vector<RingGroup> group;
  std::vector<Index> vertex;  ///< of the groups, in rows of four
  std::vector<Index> others;  ///< the vertices that are in no group: where not is_ringed, where
                              ///< many meet, and about the last one, as kernels read behind rows

  /// The groups in parts, for as many tasks.
  std::int64_t parts() const {
    return (static_cast<std::int64_t>(group.size()) + groups_per_part - 1) / groups_per_part;
  }
  bool are_worth_sharing() const {
    return static_cast<std::int64_t>(vertex.size()) >= worth_sharing;
  }
};

/// Which of the groups.
struct RingRange {
  const RingGroups& rings;
  std::int64_t first, groups;

  /// One of the parts.
  RingRange(const RingGroups& all, std::int64_t part)
      : rings(all),
        first(groups_per_part * part),
        groups(std::min(groups_per_part, static_cast<std::int64_t>(all.group.size()) - first)) {}

  /// Calls act(v, i) for every vertex; i is its place in the groups' rows of four.
  template <class Act>
  void for_each(const Act& act) const {
    for (std::int64_t g = 0; g < groups; ++g) {
      for (Index lane = 0; lane < rings.group[first + g].count; ++lane) {
        act(rings.vertex[rings_per_group * (first + g) + lane], rings_per_group * g + lane);
      }
    }
  }
};

}  // namespace ibmfair
