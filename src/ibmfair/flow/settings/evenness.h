// How evenly a quantity is spread over a surface. Noise covers a surface evenly; details of its
// shape, such as edges and folds, are in few places.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The lower quartile, over the `counted` unknowns, of the local means of `values` (one number, at
/// least 0, per unknown), over the mean of the local means: 1 if the quantity is everywhere the
/// same, 0 if it is absent from a quarter of the surface or everywhere. A local mean is the result
/// of `sweeps` averages over each vertex and its neighbours, which reach sqrt(sweeps) edges.
/// `counted` must not be empty.
double evenness(const Eigen::VectorXd& values, const Topology& topology, const Unknowns& unknowns,
                const std::vector<Index>& counted, int sweeps);

}  // namespace ibmfair
