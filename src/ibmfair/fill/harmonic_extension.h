// Extends values from the rim of a patch (the loops of the mesh that it closes) to its own
// vertices.
#pragma once

#include <Eigen/Core>

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// The mesh vertices on the rim of the patch, each once, sorted.
std::vector<Index> rim_vertices(const Patch& patch);

/// Extends the values `at_rim` (one row per rim_vertices(), any number of columns) to the patch's
/// own vertices, one row each. Every value is the mean of its neighbours, and so lies within the
/// range of the values at the rim.
Eigen::MatrixXd extend_harmonically(const Patch& patch, const Eigen::MatrixXd& at_rim);

}  // namespace ibmfair
