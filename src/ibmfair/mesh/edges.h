// Finds the edges of a mesh, and the triangles at each vertex and at each edge.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// For each pair of an edge and a triangle at it: the opposite vertex, and the direction of the
/// edge in the triangle. Entry i belongs to the triangle Topology::edge_triangles.value[i].
/// find_edges() computes this on the way; looking each triangle up again would take longer.
class EdgeSides {
 public:
  /// `opposite` holds the opposite vertex of every entry, or its complement (~) if the triangle
  /// runs from the larger to the smaller vertex of the edge.
  explicit EdgeSides(std::vector<Index> opposite) : opposite_(std::move(opposite)) {}

  /// The corner of the triangle of entry i that is not on the edge.
  Index opposite(std::int64_t i) const { return runs_up(i) ? opposite_[i] : ~opposite_[i]; }

  /// Whether the triangle runs from the smaller to the larger vertex of the edge.
  bool runs_up(std::int64_t i) const { return opposite_[i] >= 0; }

  /// Records that the orientation of the triangle has been reversed.
  void turn(std::int64_t i) { opposite_[i] = ~opposite_[i]; }

 private:
  std::vector<Index> opposite_;
};

/// The triangles at each vertex in increasing order; triangles with a repeated corner are left out.
CompressedRows vertex_stars(Index vertex_count, const Triangles& F);

/// Sets E, sorted by vertices, and edge_triangles, with each row in increasing order. Needs
/// vertex_count, F and stars.
EdgeSides find_edges(Topology& topology);

}  // namespace ibmfair
