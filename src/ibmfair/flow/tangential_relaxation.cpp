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
