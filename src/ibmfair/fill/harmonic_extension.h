// Extends values from the rim of a patch over its own vertices.
#pragma once

#include <Eigen/Core>

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// The mesh's vertices on the patch's rim, each once, sorted.
std::vector<Index> rim_vertices(const Patch& patch);

/// For values at `rim_vertices` (a row each, any number of columns) those at the patch's own
/// vertices: each the mean of its neighbours, so that nothing leaves the range of the rim.
Eigen::MatrixXd extend_harmonically(const Patch& patch, const Eigen::MatrixXd& at_rim);

}  // namespace ibmfair
