// Tells cracks from holes. At a hole, triangles are missing. At a crack, the triangles on both
// sides fit, but do not share their edges.
//
// Two boundary edges lie on each other if their ends coincide. A T-junction is a vertex of a
// boundary loop that lies inside a boundary edge without splitting it; it counts only if one of the
// two parts of this edge lies on a boundary edge, so that splitting the edge closes something.
// Lengths are compared with a reach: a thousandth of the shortest boundary edge at a vertex, or a
// given length.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/holes.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Vertices that split a boundary edge from a to b, in this order.
struct EdgeSplit {
  Index a = 0, b = 0;
  std::vector<Index> vertices;
};

/// Cracks of a mesh, and what closes them.
struct Cracks {
  std::vector<LoopCrack> loops;   ///< one for every hole
  std::vector<EdgeSplit> splits;  ///< for the T-junctions
  /// Pairs of vertices to merge so that edges which lie on each other become one edge; the first is
  /// the smaller one, and stays. Sorted by the second.
  std::vector<std::array<Index, 2>> merged;
  double farthest = 0;  ///< of two merged vertices from each other, length

  bool empty() const { return splits.empty() && merged.empty(); }
  Index t_junctions() const;
};

/// Finds the cracks between the boundary loops `holes` of a mesh. With `reach` (length), vertices
/// and edges coincide that are this close to each other, but never as far apart as 0.3 of the
/// boundary edges there. Takes time proportional to the number of boundary edges, if these are of
/// similar length.
Cracks find_cracks(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
                   std::optional<double> reach = {});

}  // namespace ibmfair
