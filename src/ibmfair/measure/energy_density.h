// Where on a mesh its bending energy sits.
#pragma once

#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// #V, 1/length^2: what of E_b belongs to a vertex (BendingEnergy::energy_by_vertex, with mass),
/// over its lumped mass. The sum of density times lumped mass is E_b. NaN at a vertex without mass,
/// to which nothing is given. Throws BadOption for an unknown model.
PerVertex energy_density(const Points& X, const Topology& topology, std::string_view model);

}  // namespace ibmfair
