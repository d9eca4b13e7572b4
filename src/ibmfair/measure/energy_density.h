// The distribution of the bending energy over a mesh.
#pragma once

#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// #V, 1/length^2: the part of E_b that belongs to a vertex (BendingEnergy::energy_by_vertex, with
/// mass matrix), divided by the vertex's lumped mass. The sum of density times lumped mass is E_b.
/// NaN at vertices without mass, to which no energy belongs. Throws BadOption for an unknown model.
PerVertex energy_density(const Points& X, const Topology& topology, std::string_view model);

}  // namespace ibmfair
