// Walls that are too thin for the mesh: thinner than two edges and than a quarter of the cut-off.
//
// At its rim such a wall is a sharp fold, as if a sheet were folded back onto itself. Bending
// energy rounds the fold, and does so by blowing the wall up: a plate of 14 x 14 x 0.1 edges had 24
// times its volume afterwards. If the rims stay, the two sheets of a wall flow as two surfaces with
// clamped boundaries.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"
#include "ibmfair/mesh/wall_thickness.h"

namespace ibmfair {

/// Walls behind some of the triangles, evenly spread over their numbers: all triangles of a small
/// mesh.
struct WallSample {
  std::vector<Index> triangles;
  std::vector<Wall> walls;  ///< one for each of `triangles`; some have none
};

/// Walls of a closed mesh that are thinner than two mean edge lengths and a quarter of `cutoff`.
/// What noise has crumpled has no walls.
WallSample sample_walls(const Points& X, const Topology& topology, double cutoff);

/// The median, over the sampled walls, of the ratio of the thickness at Y to that at X; 1 if less
/// than a hundredth of the sampled area has walls.
double median_thickening(const Points& X, const Points& Y, const Topology& topology,
                         const WallSample& sample);

/// The components that are thin walls: those of whose area a quarter or more has walls in the
/// sample, as a plate has, but not a body with thin ears.
struct ThinWalls {
  std::vector<Wall> walls;         ///< #F, or empty if there are no such components
  std::vector<std::uint8_t> rims;  ///< #V flags: where two sheets meet, and the next ring
};

ThinWalls thin_walls(const Points& X, const Topology& topology, const WallSample& sample);

}  // namespace ibmfair
