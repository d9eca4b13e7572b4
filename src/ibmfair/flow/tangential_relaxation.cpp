#include "ibmfair/flow/tangential_relaxation.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

TangentialRelaxation::TangentialRelaxation(const Topology& topology, const Unknowns& unknowns)
    : topology_(topology), vertex_(unknowns.vertex) {
  std::vector<Index> ring;
  for (Index& v : vertex_) {
    ring.clear();
    if (topology.kind[v] == VertexKind::interior && !topology.twisted[v]) {
      for (const Index t : topology.stars[v]) {
        ring.insert(ring.end(), topology.F.row(t).begin(), topology.F.row(t).end());
      }
      std::sort(ring.begin(), ring.end());
      ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
      std::erase(ring, v);
    } else {
      v = -1;
    }
    neighbours_.value.insert(neighbours_.value.end(), ring.begin(), ring.end());
    neighbours_.first.push_back(static_cast<std::int64_t>(neighbours_.value.size()));
  }
}

void TangentialRelaxation::moves(const Points& X, Points& move) const {
  move.resize(static_cast<Eigen::Index>(vertex_.size()), 3);
  parallel_for(move.rows(), [&](std::int64_t u) {
    const Index v = vertex_[u];
    Vec3 step = Vec3::Zero();
    if (v >= 0) {
      const auto ring = neighbours_[static_cast<Index>(u)];
      for (const Index q : ring) {
        step += (X.row(q) - X.row(v)).transpose();
      }
      step /= 2 * static_cast<double>(ring.size());
      Vec3 normal = Vec3::Zero();
      for (const Index t : topology_.stars[v]) {
        const auto x = topology_.F.row(t);
        normal += double_area_vector(X.row(x[0]), X.row(x[1]), X.row(x[2]));
      }
      const double squared = normal.squaredNorm();
      step -= squared > 0 ? Vec3(normal * (normal.dot(step) / squared)) : step;
    }
    move.row(u) = step;
  });
}

}  // namespace ibmfair
