// Normals of the vertices that move, and heights along them.
#pragma once

#include <Eigen/Core>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Area-weighted normals of the unknown vertices, one row each: unit length, or zero if a vertex
/// has no normal.
Points unknown_normals(const Points& X, const Topology& topology, const Unknowns& unknowns);

/// The heights of the unknown vertices of `Y` over those of `X` along these normals, length: one
/// number per unknown.
Eigen::VectorXd heights_along(const Points& normals, const Points& Y, const Points& X,
                              const Unknowns& unknowns);

}  // namespace ibmfair
