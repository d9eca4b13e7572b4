#include "ibmfair/flow/tangential_relaxation.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

// Seen along the normal, triangles that lean keep a part of their area: this much where they lean
// by 45 degrees. A vertex sticks out where less is left of its own, as of flaps and spikes.
constexpr double little_left = 0.7;

/// What the neighbours keep of their normals' lengths where the surface is the edge of a wedge and
/// the vertex keeps this share: two of six lie on the edge, too.
double left_around_edge(double left) {
  return 3 * left / (2 + left);
}
constexpr double more_left = 1.02;  // times that, where the neighbours are no wedge

}  // namespace

TangentialRelaxation::TangentialRelaxation(const Topology& topology, const Rows& rings,
                                           const Unknowns& unknowns, const MeshParts& parts,
                                           bool unfolds)
    : topology_(topology), rings_(rings), unknowns_(unknowns), parts_(parts), unfolds_(unfolds) {}

void TangentialRelaxation::moves(const Points& X, Points& move) {
  find_normals(X);
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
      if (!sticks_out(v)) {
        const Vec3 normal = normals_.row(v);
        const double squared = normal.squaredNorm();
        step -= squared > 0 ? Vec3(normal * (normal.dot(step) / squared)) : step;
      }
    }
    move.row(u) = step;
  });
}

void TangentialRelaxation::find_normals(const Points& X) {
  normals_.resize(X.rows(), 3);
  left_.resize(X.rows());
  parallel_for(X.rows(), [&](std::int64_t v) {
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const Index t : topology_.stars[v]) {
      const auto x = topology_.F.row(t);
      const Vec3 N = double_area_vector(X.row(x[0]), X.row(x[1]), X.row(x[2]));
      sum += N;
      area += N.norm();
    }
    normals_.row(v) = sum;
    left_[v] = area > 0 ? sum.norm() / area : 0;
  });
  parts_.refresh(normals_);
}

bool TangentialRelaxation::sticks_out(Index v) const {
  if (!unfolds_ || left_[v] > little_left) {
    return false;
  }
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (const Index q : rings_[v]) {
    const Vec3 N = normals_.row(q);
    sum += N;
    length += N.norm();
  }
  return sum.norm() > more_left * left_around_edge(left_[v]) * length;
}

}  // namespace ibmfair
