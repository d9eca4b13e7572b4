// How far the vertices of a mesh have moved.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The component of X - `before` along the normals at X (measure/mean_curvature.h), #V, length:
/// positive if a vertex moved outward. `before` may have fewer rows than X; the remaining vertices
/// are new and get NaN.
PerVertex normal_displacement(const Points& before, const Points& X, const Topology& topology);

/// The length of X - `before`, #V, length; NaN for new vertices.
PerVertex displacement_length(const Points& before, const Points& X);

}  // namespace ibmfair
