// Parts of a mesh that stand up from its surface at the rim of a hole, and that must not decide how
// the hole is filled.
#pragma once

#include <vector>

#include "ibmfair/fill/patch.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The triangles of fins, sorted. A fin is a small sheet of triangles that hangs on a much larger
/// surface by edges of three or more triangles.
std::vector<Index> find_fins(const Topology& topology);

/// The topology without these triangles. Triangles keep their numbers: those left out have one
/// vertex as all their corners.
Topology without_triangles(const Topology& topology, const std::vector<Index>& triangles);

/// Moves triangles from the surroundings of the patch to Patch::protruding. `around`: the mesh
/// triangle of each of the surrounding triangles.
void leave_out_protruding(Patch& patch, const std::vector<Index>& around);

}  // namespace ibmfair
