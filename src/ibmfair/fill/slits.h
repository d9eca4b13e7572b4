// Slits: holes so narrow that their sides run along each other.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/holes.h"
#include "ibmfair/mesh/box_grid.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Searches the boundary loops of a mesh for slits. A loop is a side of a slit if each vertex and
/// the middle of each edge has a boundary edge of this or another loop across the gap, at a
/// distance of at most a tenth of the loop's mean edge length. At the end of a slit, the two edges
/// of a vertex run along each other.
class SlitSearch {
 public:
  /// The arguments must outlive this object. `holes`: all loops of the mesh.
  SlitSearch(const Points& X, const Topology& topology, const std::vector<Hole>& holes);

  /// The largest of these distances (length), if the loop is a side of a slit.
  std::optional<double> width_at(const Hole& hole) const;

 private:
  using LoopEdge = std::pair<Index, Index>;

  /// A vertex of a loop, or a point inside one of its edges, with the edges there.
  struct RimPoint {
    Vec3 x;
    std::array<LoopEdge, 2> edges;
  };

  double distance_across(const RimPoint& point, double most) const;
  double distance_at_end(Index last, Index v, Index next) const;
  Vec3 inward_at(const LoopEdge& edge) const;

  const Points& X_;
  const Topology& topology_;
  std::vector<LoopEdge> edges_;  // of all loops
  BoxGrid grid_;                 // of the edges
};

}  // namespace ibmfair
