#include "ibmfair/energy/bending_energy.h"

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

/// The energy 1/2 w |sum c_i x_i|^2 of stencil s, divided by its number of vertices. Because the
/// coefficients sum to zero, positions can be taken relative to one of the vertices, so that no
/// digits are lost far from the origin.
double share_of_stencil(const Points& X, const CompressedRows& stencils,
                        const StencilWeights& weights, Index s) {
  const auto vertices = stencils[s];
  const Vec3 origin = X.row(vertices[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    sum += weights.c[stencils.first[s] + i] * (X.row(vertices[i]).transpose() - origin);
  }
  return weights.w[s] * sum.squaredNorm() / (2 * static_cast<double>(vertices.size()));
}

}  // namespace

PerVertex BendingEnergy::energy_by_vertex(const Points& X) {
  const CompressedRows& rows = stencils();
  StencilWeights weights;
  linearise(X, weights);
  Eigen::VectorXd shares(rows.size());
  parallel_for(rows.size(), [&](std::int64_t s) {
    shares[s] = share_of_stencil(X, rows, weights, static_cast<Index>(s));
  });
  PerVertex energy = PerVertex::Zero(X.rows());
  for (Index s = 0; s < rows.size(); ++s) {
    for (const Index v : rows[s]) {
      energy[v] += shares[s];
    }
  }
  return energy;
}

}  // namespace ibmfair
