#include "ibmfair/measure/energy_density.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// 1/2 w |sum c_i x_i|^2 of stencil s over its number of vertices. The coefficients sum to zero:
/// seen from one of the vertices no digits are lost far from the origin.
double share_of_stencil(const Points& X, const Rows& stencils, const StencilWeights& weights,
                        Index s) {
  const auto vertices = stencils[s];
  const Vec3 origin = X.row(vertices[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    sum += weights.c[stencils.first[s] + i] * (X.row(vertices[i]).transpose() - origin);
  }
  return weights.w[s] * sum.squaredNorm() / (2 * static_cast<double>(vertices.size()));
}

}  // namespace

PerVertex energy_density(const Points& X, const Topology& topology, std::string_view model) {
  const auto energy = bending_model(model).bind(topology, {});
  const Rows& stencils = energy->stencils();
  StencilWeights weights;
  energy->linearise(X, weights);
  Eigen::VectorXd shares(stencils.size());
  parallel_for(stencils.size(), [&](std::int64_t s) {
    shares[s] = share_of_stencil(X, stencils, weights, static_cast<Index>(s));
  });
  PerVertex density = PerVertex::Zero(topology.vertex_count);
  for (Index s = 0; s < stencils.size(); ++s) {
    for (const Index v : stencils[s]) {
      density[v] += shares[s];
    }
  }
  return density.cwiseQuotient(lumped_vertex_mass(X, topology));
}

}  // namespace ibmfair
