// Means over vertices and their neighbours.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The mean over each unknown and the unknowns that edges join to it, `times` over. `values`: one
/// row per unknown.
Points ring_means(Points values, const Topology& topology, const Unknowns& unknowns, int times);
Eigen::VectorXd ring_means(Eigen::VectorXd values, const Topology& topology,
                           const Unknowns& unknowns, int times);

}  // namespace ibmfair
