#include "ibmfair/flow/steps/unknown_normals.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

Points unknown_normals(const Points& X, const Topology& topology, const Unknowns& unknowns) {
  Points normals(unknowns.size(), 3);
  parallel_for(unknowns.size(), [&](std::int64_t u) {
    const Vec3 N = double_area_vector_at(unknowns.vertex[u], X, topology);
    const double length = N.norm();
    normals.row(u) = length > 0 ? Vec3(N / length) : N;
  });
  return normals;
}

Eigen::VectorXd heights_along(const Points& normals, const Points& Y, const Points& X,
                              const Unknowns& unknowns) {
  Eigen::VectorXd heights(unknowns.size());
  parallel_for(unknowns.size(), [&](std::int64_t u) {
    const Index v = unknowns.vertex[u];
    heights[u] = normals.row(u).dot(Y.row(v) - X.row(v));
  });
  return heights;
}

}  // namespace ibmfair
