// Vertices in groups of four whose rings (cycles of neighbours) have the same length. The kernels
// that visit the ring of every vertex in each step of a flow (flow/steps/ring_kernels.h) process a
// group at a time; vertex by vertex they would take two to three times as long.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The number of vertices in a group: the number of lanes of a kernel (base/lanes.h).
inline constexpr Index rings_per_group = 4;

/// The largest number of groups in a part. The size of a buffer: it changes no decision.
inline constexpr std::int64_t groups_per_part = 32;

struct RingGroup {
  Index length = 0;  ///< number of neighbours in each of the rings
  Index count = 0;   ///< number of vertices; a smaller group is padded with its first vertex
};

struct RingGroups {
  /// Groups the unknown vertices and their neighbours. `rings` (the result of vertex_rings) must
  /// outlive this object.
  RingGroups(const Topology& topology, const CompressedRows& rings, const Unknowns& unknowns);

  const CompressedRows& rings;
  std::vector<RingGroup> group;
  std::vector<Index> vertex;  ///< the vertices of the groups, four per group
  /// The vertices in no group: those without a closed ring (is_ringed), those with many neighbours,
  /// and the last vertex of the mesh with its neighbours, as kernels read beyond the end of a row.
  std::vector<Index> others;

  /// The number of parts into which the groups are split, one task each.
  std::int64_t parts() const {
    return (static_cast<std::int64_t>(group.size()) + groups_per_part - 1) / groups_per_part;
  }
  bool are_worth_sharing() const {
    return static_cast<std::int64_t>(vertex.size()) >= worth_sharing;
  }
};

/// A range of the groups.
struct RingRange {
  const RingGroups& rings;
  std::int64_t first, groups;

  /// The range of the groups of part number `part`.
  RingRange(const RingGroups& all, std::int64_t part)
      : rings(all),
        first(groups_per_part * part),
        groups(std::min(groups_per_part, static_cast<std::int64_t>(all.group.size()) - first)) {}

  /// Calls act(v, i) for every vertex v of the range; i is its position in the range, counting four
  /// per group.
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
