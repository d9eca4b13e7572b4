// Short paths over the surface from one side of a wall to the other.
#pragma once

#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Shortest paths along edges between triangles (Dijkstra's algorithm).
class RimPaths {
 public:
  /// `rings` is the result of vertex_rings; all arguments must outlive this object.
  RimPaths(const Points& X, const Topology& topology, const CompressedRows& rings)
      : X_(X), topology_(topology), rings_(rings) {}

  /// The vertices of the shortest path from a corner of `from` to a corner of `to`, both included;
  /// empty if the path is longer than `longest` (length), or if vertices with
  /// very many neighbours lie around (ThinWallTuning::most_seen).
  std::vector<Index> find(Index from, Index to, double longest);

 private:
  struct Reached {
    double length;
    Index before;
  };
  using Item = std::pair<double, Index>;

  void visit(Index v, Index before, double length);
  std::vector<Index> path_to(Index v) const;

  const Points& X_;
  const Topology& topology_;
  const CompressedRows& rings_;
  std::unordered_map<Index, Reached> reached_;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue_;
};

}  // namespace ibmfair
