// One orientation per component, whatever orientations the file has.
#pragma once

#include "ibmfair/mesh/edges.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Turns triangles of `topology.F` so that the two triangles at every edge of exactly two run
/// through it in opposite directions; each connected patch keeps the orientation of most of its
/// triangles. Where that is impossible (Moebius strip) sets `orientable` to false and marks the
/// vertices of the edges that still disagree as `twisted`. Needs E, edge_triangles and their
/// sides, which turn with the triangles; sets F, twisted, turned_triangles, orientable.
void orient_coherently(Topology& topology, EdgeSides& sides);

}  // namespace ibmfair
