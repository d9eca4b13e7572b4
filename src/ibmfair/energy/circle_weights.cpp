#include "ibmfair/energy/circle_weights.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/vertex_triangles.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/edges.h"

namespace ibmfair {

CircleWeights::CircleWeights(const Topology& topology) : F_(usable_triangles(topology)) {
  stars_ = vertex_stars(topology.vertex_count, F_);
  radius_ = weight_ = PerVertex::Zero(topology.vertex_count);
}

const PerVertex& CircleWeights::at(const Points& X) {
  parallel_for(X.rows(), [&](std::int64_t i) {
    const auto v = static_cast<Index>(i);
    double sum = 0;
    for (const Index t : stars_[v]) {
      for (const Index u : other_corners(F_, t, v)) {
        sum += (X.row(u) - X.row(v)).norm();
      }
    }
    const auto edges = 2 * static_cast<double>(stars_[v].size());
    radius_[v] = edges > 0 ? sum / (2 * edges) : 0;
    weight_[v] = radius_[v] * radius_[v];
  });
  return weight_;
}

void CircleWeights::pull_back(const Points& X, const PerVertex& by_weight, Points& G) const {
  // The derivative with respect to the length of an edge at v, for one of the triangles at the
  // edge.
  const auto by_length = [&](Index v) {
    return 2 * radius_[v] * by_weight[v] / (4 * static_cast<double>(stars_[v].size()));
  };
  parallel_for(X.rows(), [&](std::int64_t i) {
    const auto v = static_cast<Index>(i);
    Vec3 g = Vec3::Zero();
    for (const Index t : stars_[v]) {
      for (const Index u : other_corners(F_, t, v)) {
        const Vec3 edge = X.row(v) - X.row(u);
        g += (by_length(v) + by_length(u)) * edge.normalized();
      }
    }
    G.row(v) += g;
  });
}

}  // namespace ibmfair
