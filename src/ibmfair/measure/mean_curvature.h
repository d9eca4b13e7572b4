// The mean curvature of a mesh at its vertices.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// #V x 3 unit normals: the mean of the normals of the triangles around each vertex weighted by
/// area, with the orientation of Topology::F; zero where there is none.
Points star_normals(const Points& X, const Topology& topology);

/// H = kappa1 + kappa2, #V, 1/length: the gradient of the area with respect to the vertex (the
/// cotangent Laplacian of its position) along its normal, over its mixed Voronoi area (Meyer,
/// Desbrun, Schroeder, Barr, "Discrete Differential-Geometry Operators for Triangulated
/// 2-Manifolds", 2003). Positive where a surface that is oriented outward bulges, 2/r on a sphere;
/// on a cut where no orientation agrees the sign means nothing. NaN where the mesh does not tell:
/// at vertices without a complete ring of triangles that have area (isolated ones, on the boundary,
/// beside defects).
PerVertex mean_curvature(const Points& X, const Topology& topology);

}  // namespace ibmfair
