#include "ibmfair/flow/time_scale.h"

#include <cmath>
#include <numbers>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

double time_for_cutoff(double cutoff) {
  return std::pow(cutoff / (2 * std::numbers::pi), 4);
}

double time_in_flow_units(double time, const Points& X, const Topology& topology,
                          const FlowOptions& options) {
  const double area = surface_area(X, topology.F);
  if (!(area > 0)) {
    return time;
  }
  if (options.metric == Metric::identity) {
    time *= static_cast<double>(topology.vertex_count) / area;
  }
  if (!options.mass) {
    const auto energy = bending_model(options.laplacian).bind(topology, {});
    StencilWeights weights;
    energy->linearise(X, weights);
    double mass = 0;
    for (const double w : weights.w) {
      mass += 1 / w;
    }
    time *= weights.w.empty() ? 1 : static_cast<double>(weights.w.size()) / mass;
  }
  return time;
}

}  // namespace ibmfair
