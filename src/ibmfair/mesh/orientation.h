// Gives each component of a mesh one orientation, whatever orientations the file has.
#pragma once

#include "ibmfair/mesh/edges.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Reverses triangles of `topology.F` so that, at every edge with exactly two triangles, the two
/// run along the edge in opposite directions. Each connected patch keeps the orientation of most of
/// its triangles. If no such orientation exists (Moebius strip), sets `orientable` to false and
/// marks the vertices of the edges at which two triangles still disagree as `twisted`. Needs E and
/// edge_triangles. Sets F, twisted, turned_triangles and orientable, and updates `sides` for the
/// reversed triangles.
void orient_coherently(Topology& topology, EdgeSides& sides);

}  // namespace ibmfair
