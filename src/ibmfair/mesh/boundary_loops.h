// Fans of corners around vertices, and the loops of boundary edges that run between them.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {

/// The corners (triangle t, place i: number 3 t + i) joined across edges of exactly two triangles.
class Fans {
 public:
  explicit Fans(const Topology& topology);

  /// The fan of the corner of triangle t at vertex v, named by its smallest corner.
  Index at(const Topology& topology, Index t, Index v) const;

  /// The number of fans at v.
  Index count(const Topology& topology, Index v) const;

 private:
  std::vector<Index> fan_;
};

/// Joins the edges of exactly one triangle end to end. At a bow-tie the walk stays within a fan, so
/// that loops which touch at a vertex are told apart. Ordered by smallest vertex, each loop
/// starting there and running so that its triangles lie to the left.
std::vector<BoundaryLoop> find_boundary_loops(const Topology& topology, const Fans& fans);

}  // namespace ibmfair
