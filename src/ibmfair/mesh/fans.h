// A fan is a set of triangle corners at a vertex that are connected across edges with exactly two
// triangles. On a surface, each vertex has one fan.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Stars with up to this many triangles are searched linearly in each step of a walk around the
/// vertex; for larger stars, sorting is faster.
inline constexpr std::size_t most_in_short_star = 32;

/// Lists the neighbours of v in `ring`, in the order of the triangles around v. is_ringed(v) must
/// hold.
void walk_around(const Topology& topology, Index v, Index* ring);

/// Whether the triangles at v form a single fan. No edge at v may have more than two triangles.
bool is_one_fan(const Topology& topology, Index v);

/// Assigns different numbers to all fans with a boundary edge. The fan of a regular vertex has the
/// number of the vertex; the fans of irregular vertices are numbered from #V on.
class Fans {
 public:
  /// Needs F, stars and kind of `topology`.
  explicit Fans(const Topology& topology);

  /// One more than the largest fan number.
  Index bound() const { return bound_; }

  /// The number of the fan that has the corner of triangle t at vertex v.
  Index at(const Topology& topology, Index t, Index v) const;

 private:
  Index bound_;
  std::vector<Index> irregular_;  // the irregular vertices, in increasing order
  CompressedRows fan_;            // for each irregular vertex, the fan of each triangle in its star
};

}  // namespace ibmfair
