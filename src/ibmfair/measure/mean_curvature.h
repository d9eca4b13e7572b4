// The mean curvature of a mesh at its vertices.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// #V x 3 unit normals: the area-weighted mean of the normals of the triangles around each vertex,
/// with the orientation of Topology::F; zero if there is no such mean.
Points star_normals(const Points& X, const Topology& topology);

/// H = kappa1 + kappa2, #V, 1/length: the gradient of the area with respect to the vertex position
/// (the cotangent Laplacian of the positions) along the vertex normal, divided by the mixed Voronoi
/// area (Meyer, Desbrun, Schroeder, Barr, "Discrete Differential-Geometry Operators for
/// Triangulated 2-Manifolds", 2003). On a surface that is oriented outward, H is positive where the
/// surface is convex, and 2/r on a sphere. On a cut of a non-orientable surface, where orientations
/// disagree, the sign has no meaning. NaN where H is undefined: at vertices without a complete ring
/// of triangles with area (isolated vertices, boundary vertices, vertices beside defects).
PerVertex mean_curvature(const Points& X, const Topology& topology);

}  // namespace ibmfair
