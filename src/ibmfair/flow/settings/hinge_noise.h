// Estimates noise by the angles of hinges (edges with their two triangles).
//
// On a part with edges, cut-offs of some edges' length remove much of the shape at every vertex
// near an edge, and of a coarse part these are most vertices. But most of its hinges would be flat
// without noise, and the flattest of all tell how strong the noise is.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The standard deviation of the angle of hinge h (radians over length) if its vertices move by
/// independent noise of the standard deviation 1 along the normals. The vertices of the edge are
/// taken to share equally what the other two leave. Infinite for triangles without area.
double bend_by_noise(const Points& X, const Hinges& H, Eigen::Index h);

/// The standard deviation (length) of independent normal noise along the normals of a mesh at X (#V
/// x 3), by the quantiles of 10, 25 and 50 % of the angles of its hinges; 0 if these tell different
/// ones, as where noise is only in some places, or where the shape bends most hinges. `fixed`: #V
/// flags; hinges whose edge is fixed do not count. Right to 6 % for noise of 0.05 to 0.2 mean edge
/// lengths on most parts, too small for stronger noise, and too large where a shape bends all
/// hinges.
double noise_by_hinges(const Points& X, const Topology& topology,
                       const std::vector<std::uint8_t>& fixed);

}  // namespace ibmfair
