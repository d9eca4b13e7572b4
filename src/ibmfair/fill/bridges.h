// Bridges: tubes that join two holes instead of filling them.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/fill/holes.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The bridges of a mesh. Two pieces that are oriented against each other, such as one that was
/// stored inside out, can be joined if all triangles of one of them are reversed first.
struct BridgePlan {
  std::vector<Index> other_end;        ///< #holes: the hole at the other end of the bridge, or -1
  std::vector<std::uint8_t> reversed;  ///< #components, whether the component must be reversed

  bool reverses_any() const;
};

/// Plans the bridges of `choice`. Throws BadOption, with the reason, for holes that other options
/// leave out or that are ends of two bridges, for loops that cannot be the end of a tube, and for
/// bridges that would make the surface one-sided. Pieces that are joined for the first time are
/// oriented so that their ends fit. Precondition: require_known_holes.
BridgePlan plan_bridges(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
                        const HoleChoice& choice);

/// The topology with the triangles of these components (flags, #components) reversed.
Topology with_reversed_components(const Topology& topology,
                                  const std::vector<std::uint8_t>& reversed);

}  // namespace ibmfair
