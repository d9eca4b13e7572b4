// Fairs a part of a mesh again, on the triangles that it has: [W07] Figure 8, right.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/patch_fairing.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct RegionReport {
  FairingReport fairing;
  std::int64_t folds = 0;  ///< hinges at free vertices that are folded over at the end
};

/// Takes the vertices of `X` (#V x 3) for which `region` is set to the stationary point of E_b, all
/// others fixed: the two rings around the region then prescribe positions and normals. Vertices at
/// defects and on open boundaries stay where they are. Throws BadOption for an empty region.
RegionReport fair_region(Points& X, const Topology& topology,
                         const std::vector<std::uint8_t>& region, const FairingOptions& options);

/// The vertices of `region` whose neighbours all belong to it.
std::vector<std::uint8_t> inner_vertices(const Topology& topology,
                                         const std::vector<std::uint8_t>& region);

}  // namespace ibmfair
