// Cuts a graph with node positions in two by a small separator.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The two sides and the separator of a graph. No edge runs from one side to the other.
struct Separation {
  std::array<std::vector<Index>, 2> side;  ///< nodes, increasing
  std::vector<Index> separator;  ///< all other nodes; empty if the sides are not connected
};

/// Cuts a graph by a plane. `graph` lists each edge at both ends, and `X` (#nodes x 3) has the
/// positions of the nodes. Planes of 13 directions are tried, at all heights that leave at least a
/// fifth of the nodes on either side; the plane with the smallest separator relative to the square
/// root of the size of the smaller side is chosen. The separator consists of the nodes on one side
/// that have an edge through the plane. Returns nothing if there is no such plane or if a
/// coordinate is not finite.
std::optional<Separation> separate(const CompressedRows& graph, const Points& X);

}  // namespace ibmfair
