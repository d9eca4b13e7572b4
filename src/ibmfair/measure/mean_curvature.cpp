#include "ibmfair/measure/mean_curvature.h"

#include <algorithm>
#include <limits>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The contributions of a triangle to its corner v: twice its area vector, twice the gradient of
/// its area, and its share of the mixed Voronoi area.
struct CornerShare {
  Vec3 double_area = Vec3::Zero();
  Vec3 double_gradient = Vec3::Zero();
  double voronoi_area = 0;
};

/// The mixed Voronoi area of a corner. In an obtuse triangle the circumcentre lies outside; half of
/// the area then belongs to the obtuse corner, and a quarter to each of the others.
double voronoi_share(const Vec3& va, const Vec3& vb, double double_area) {
  const Vec3 ab = vb - va;
  const double at_v = va.dot(vb), at_a = -va.dot(ab), at_b = vb.dot(ab);
  if (at_v < 0) {
    return double_area / 4;
  }
  if (at_a < 0 || at_b < 0) {
    return double_area / 8;
  }
  return (va.squaredNorm() * at_b + vb.squaredNorm() * at_a) / (8 * double_area);
}

CornerShare corner_share(const Points& X, const Triangles& F, Index t, Index v) {
  const auto [a, b] = other_corners(F, t, v);
  const Vec3 va = X.row(a) - X.row(v), vb = X.row(b) - X.row(v);
  CornerShare share;
  share.double_area = va.cross(vb);
  const double double_area = share.double_area.norm();
  share.double_gradient = (share.double_area / double_area).cross(vb - va);
  share.voronoi_area = voronoi_share(va, vb, double_area);
  return share;
}

bool has_complete_ring(const Topology& topology, Index v) {
  const auto star = topology.stars[v];
  return topology.kind[v] == VertexKind::interior &&
         std::all_of(star.begin(), star.end(), [&](Index t) { return topology.usable[t] != 0; });
}

}  // namespace

Points star_normals(const Points& X, const Topology& topology) {
  Points normals(topology.vertex_count, 3);
  parallel_for(topology.vertex_count, [&](std::int64_t v) {
    const Vec3 sum = double_area_vector_at(static_cast<Index>(v), X, topology);
    const double length = sum.norm();
    normals.row(v) = length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
  });
  return normals;
}

PerVertex mean_curvature(const Points& X, const Topology& topology) {
  PerVertex H(topology.vertex_count);
  parallel_for(topology.vertex_count, [&](std::int64_t i) {
    const auto v = static_cast<Index>(i);
    if (!has_complete_ring(topology, v)) {
      H[i] = std::numeric_limits<double>::quiet_NaN();
      return;
    }
    CornerShare sum;
    for (const Index t : topology.stars[v]) {
      const CornerShare share = corner_share(X, topology.F, t, v);
      sum.double_area += share.double_area;
      sum.double_gradient += share.double_gradient;
      sum.voronoi_area += share.voronoi_area;
    }
    H[i] = sum.double_gradient.dot(sum.double_area.normalized()) / (2 * sum.voronoi_area);
  });
  return H;
}

}  // namespace ibmfair
