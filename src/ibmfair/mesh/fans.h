// Fans: the corners at a vertex that are joined across edges of exactly two triangles. A surface
// has one fan at each vertex.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The most triangles of a star that is searched from end to end for each step of a walk; sorting
/// pays beyond.
inline constexpr std::size_t most_in_short_star = 32;

/// Lists the neighbours of v, which is_ringed, in the order of its triangles.
void walk_around(const Topology& topology, Index v, Index* ring);

/// Whether the triangles at v form one fan. No edge at v may have more than two triangles.
bool is_one_fan(const Topology& topology, Index v);

/// The number of every fan that has a boundary edge, such that no two have the same: at a vertex
/// with a single fan it is the number of the vertex, at an irregular one it comes after these.
class Fans {
 public:
  /// Needs F, stars, kind.
  explicit Fans(const Topology& topology);

  /// One more than the largest number.
  Index bound() const { return bound_; }

  /// The fan of the corner of triangle t at vertex v.
  Index at(const Topology& topology, Index t, Index v) const;

 private:
  Index bound_;
  std::vector<Index> irregular_;  // the irregular vertices, in increasing order
  Rows fan_;                      // for each of them the fans of the triangles in its star
};

}  // namespace ibmfair
