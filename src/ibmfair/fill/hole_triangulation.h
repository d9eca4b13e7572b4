// The first triangulation of a hole: no new vertices, from CGAL's Polygon Mesh Processing (Liepa's
// dynamic programme over a three-dimensional Delaunay triangulation).
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Triangulates the closed polygon with corners `loop` (#L x 3, #L >= 3) so that dihedral angles
/// are small, those toward the mesh included: `apex` (#L x 3) has the third corner of the triangle
/// behind the edge from corner i to i + 1. Triangles number the polygon's corners and run along its
/// edges in its direction; there are none where no triangulation was found.
Triangles triangulate_hole(const Points& loop, const Points& apex);

}  // namespace ibmfair
