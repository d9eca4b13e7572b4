#include "ibmfair/flow/time_scale.h"

#include <cmath>
#include <numbers>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/part_measures.h"

namespace ibmfair {

double time_for_cutoff(double cutoff) {
  return std::pow(cutoff / (2 * std::numbers::pi), 4);
}

double time_in_flow_units(double time, const Points& X, const Topology& topology,
                          const FlowOptions& options, const MeshParts& parts) {
  const double area = surface_area(X, topology, parts);
  if (!(area > 0)) {
    return time;
  }
  double own_vertices = 0;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    own_vertices += parts.owns_vertex(v) ? 1 : 0;
  }
  if (options.metric == Metric::identity || options.counts_valence()) {
    time *= parts.sum(own_vertices) / area;
  }
  const BendingModel& model = bending_model(options.laplacian);
  if (!mass_matrix(model, options.energy_options()).measures_area()) {
    const auto energy = model.create(topology, {.mass_matrix = std::string(area_mass(model).name)});
    StencilWeights weights;
    energy->linearise(X, weights);
    double mass = 0, count = 0;
    for (Index s = 0; s < energy->stencils().size(); ++s) {
      const double share = own_share(energy->stencils()[s], parts);
      mass += share / weights.w[s];
      count += share;
    }
    mass = parts.sum(mass);
    count = parts.sum(count);
    time *= count > 0 ? count / mass : 1;
  }
  return time;
}

}  // namespace ibmfair
