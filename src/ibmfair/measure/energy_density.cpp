#include "ibmfair/measure/energy_density.h"

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

PerVertex energy_density(const Points& X, const Topology& topology, std::string_view model) {
  return bending_model(model)
      .create(topology, {})
      ->energy_by_vertex(X)
      .cwiseQuotient(lumped_vertex_mass(X, topology));
}

}  // namespace ibmfair
