// Fairs a region of a mesh without changing its triangulation: [W07] Figure 8, right.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/patch_fairing.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct RegionReport {
  FairingReport fairing;
  std::int64_t folds = 0;  ///< hinges (edges with their two triangles) folded over at the end
};

/// Moves the vertices of `X` (#V x 3) flagged in `region` (#V) to the stationary point of E_b. All
/// other vertices are fixed: the two rings around the region prescribe positions and normals.
/// Vertices at defects and on open boundaries are fixed, too. Throws BadOption if no vertex of the
/// region can move.
RegionReport fair_region(Points& X, const Topology& topology,
                         const std::vector<std::uint8_t>& region, const FairingOptions& options);

/// Flags (#V) of the vertices of `region` whose neighbours all belong to the region.
std::vector<std::uint8_t> inner_vertices(const Topology& topology,
                                         const std::vector<std::uint8_t>& region);

}  // namespace ibmfair
