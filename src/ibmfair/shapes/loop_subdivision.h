// Smooth surfaces from coarse meshes: C. Loop, "Smooth Subdivision Surfaces Based on Triangles",
// master's thesis, University of Utah (1987).
#pragma once

#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// Splits every triangle into four and moves all vertices by Loop's rules; an open boundary is
/// subdivided as the cubic spline of its own vertices. Old vertices keep their numbers, and the new
/// vertex of edge e (a row of Topology::E) has the number #V + e. Precondition: `mesh` is a
/// surface.
TriangleMesh loop_subdivide(const TriangleMesh& mesh);

}  // namespace ibmfair
