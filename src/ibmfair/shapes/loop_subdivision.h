// Smooth surfaces from coarse ones: C. Loop, "Smooth Subdivision Surfaces Based on Triangles",
// master's thesis, University of Utah (1987).
#pragma once

#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// Splits every triangle into four and moves all vertices by Loop's rules; an open boundary follows
/// the cubic spline of its own vertices. Old vertices keep their numbers, the new one of edge e (a
/// row of Topology::E) is #V + e. Precondition: `mesh` is a surface.
TriangleMesh loop_subdivide(const TriangleMesh& mesh);

}  // namespace ibmfair
