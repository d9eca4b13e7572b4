// Which triangles meet at each vertex and at each edge, and how they lie there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// How triangles lie at their edges: side i belongs to the triangle
/// Topology::edge_triangles.value[i]. Known from finding the edges, where looking each triangle up
/// again would take longer.
class EdgeSides {
 public:
  /// The opposite vertex of every side, or its complement (~) where the triangle runs from the
  /// larger to the smaller vertex of the edge.
  explicit EdgeSides(std::vector<Index> opposite) : opposite_(std::move(opposite)) {}

  /// The corner of the triangle that is not on the edge.
  Index opposite(std::int64_t i) const { return runs_up(i) ? opposite_[i] : ~opposite_[i]; }

  /// Whether the triangle runs from the smaller to the larger vertex of the edge.
  bool runs_up(std::int64_t i) const { return opposite_[i] >= 0; }

  /// The triangle has been turned.
  void turn(std::int64_t i) { opposite_[i] = ~opposite_[i]; }

 private:
  std::vector<Index> opposite_;
};

/// The triangles at each vertex in increasing order, without those that repeat a corner.
Rows vertex_stars(Index vertex_count, const Triangles& F);

/// Sets E, sorted, and edge_triangles, each row in increasing order. Needs vertex_count, F, stars.
EdgeSides find_edges(Topology& topology);

}  // namespace ibmfair
