#include "ibmfair/flow/tangential_relaxation.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

TangentialRelaxation::TangentialRelaxation(const Topology& topology, const Rows& rings,
                                           const Unknowns& unknowns)
    : topology_(topology), rings_(rings), unknowns_(unknowns) {}

void TangentialRelaxation::moves(const Points& X, Points& move) const {
  move.resize(unknowns_.size(), 3);
  parallel_for(move.rows(), [&](std::int64_t u) {
    const Index v = unknowns_.vertex[u];
    Vec3 step = Vec3::Zero();
    if (topology_.kind[v] == VertexKind::interior && !topology_.twisted[v]) {
      const auto ring = rings_[v];
      for (const Index q : ring) {
        step += (X.row(q) - X.row(v)).transpose();
      }
      step /= 2 * static_cast<double>(ring.size());
      const Vec3 normal = double_area_vector_at(v, X, topology_);
      const double squared = normal.squaredNorm();
      step -= squared > 0 ? Vec3(normal * (normal.dot(step) / squared)) : step;
    }
    move.row(u) = step;
  });
}

}  // namespace ibmfair
