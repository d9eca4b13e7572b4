// Cutting a graph of points in two by few of its nodes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// No edge runs from one side to the other.
struct Separation {
  std::array<std::vector<Index>, 2> side;  ///< nodes, increasing
  std::vector<Index> separator;            ///< all others; none where the sides are not connected
};

/// Cuts the graph, whose edges are listed at both ends and whose nodes lie at `X` (#nodes x 3), by
/// a plane: of 13 directions and all heights that leave a fifth of the nodes on either side, the
/// one with the smallest separator for what the smaller side holds. The separator are the nodes of
/// one side that have an edge through the plane. None where no such plane is found, and where not
/// all coordinates are finite.
std::optional<Separation> separate(const Rows& graph, const Points& X);

}  // namespace ibmfair
