// The first triangulation of a hole: no new vertices, from CGAL's Polygon Mesh Processing (Liepa's
// dynamic programme over a three-dimensional Delaunay triangulation).
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The search among all triangulations, for a polygon that its Delaunay triangulation does not
/// span, is made for polygons of at most so many corners; for longer ones it would take minutes.
inline constexpr Eigen::Index longest_searched_loop = 400;

/// Triangulates the closed polygon with corners `loop` (#L x 3, #L >= 3) so that the surface bends
/// little at its edges, including the edges shared with the mesh. Row i of `apex` (#L x 3) is the
/// third corner of the mesh triangle at the edge from corner i to i + 1. The corners of the
/// resulting triangles are row numbers of `loop`; triangles at the polygon run along its edges in
/// the direction of the polygon. The result is empty if no triangulation was found.
Triangles triangulate_hole(const Points& loop, const Points& apex);

/// Triangulates the ring between two closed polygons, with the least area. Both run so that the
/// ring is to their left. Corners of the resulting triangles are row numbers of `outer`, or of
/// `inner` plus the number of rows of `outer`. Empty if the polygons have too many corners.
Triangles triangulate_ring(const Points& outer, const Points& inner);

/// Triangulates the tube between two closed polygons, which run so that the tube is to their left.
/// The polygons are brought to one size and into one plane as a tube without twist would do, and
/// the strip keeps near corners together; the least area would close each polygon by a disc if they
/// are far apart. Corners and failure as for triangulate_ring.
Triangles triangulate_tube(const Points& one, const Points& other);

}  // namespace ibmfair
