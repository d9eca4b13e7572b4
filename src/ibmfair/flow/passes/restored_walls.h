// Thin walls get their thickness back after a flow.
//
// The two sheets of a thin wall flow one by one, and where the wall is bent or its rim is bevelled
// they end a little nearer to each other or farther apart. That is little beside an edge, but much
// beside the thickness: a tray with walls of a tenth of an edge gained 60 % of volume.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "ibmfair/flow/settings/thin_walls.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Moves the vertices of walls along their normals, each sheet by one half of the change in
/// thickness from `start` to X (#V x 3), averaged over a few rings: what noise takes away or adds
/// to single vertices stays taken away. Fixed vertices (#V flags) stay. The promises of the flow
/// hold: no hinge folds over that was not folded in `start`, and the bending energy of `laplacian`
/// (a name from bending_models()) does not rise above that of `start`; the moves are shortened for
/// that.
void restore_walls(const Points& start, const Topology& topology,
                   const std::vector<std::uint8_t>& fixed, const ThinWalls& thin,
                   std::string_view laplacian, Points& X);

}  // namespace ibmfair
