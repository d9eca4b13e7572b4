// How far the vertices of a mesh have moved.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// X minus `before` along the normals at X (measure/mean_curvature.h), #V, length: positive where a
/// vertex moved out. `before` may have fewer rows than X: the vertices behind them are new, and
/// have NaN.
PerVertex normal_displacement(const Points& before, const Points& X, const Topology& topology);

/// The distance of X to `before`, #V, length; NaN for new vertices.
PerVertex displacement_length(const Points& before, const Points& X);

}  // namespace ibmfair
