#include "ibmfair/fill/delaunay.h"

#include <cmath>
#include <vector>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Smaller sines of the sum of two angles are rounding errors; without this tolerance, the edges of
/// cocircular points would flip for ever.
constexpr double angle_noise = 1e-9;

/// Whether the sum of the angles opposite to the diagonal ab of the quadrilateral p a q b is at
/// most pi: whether the sum of their cotangents is not negative.
bool is_delaunay(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const Vec3 pa = a - p, pb = b - p, qa = a - q, qb = b - q;
  const double cos_p = pa.dot(pb), cos_q = qa.dot(qb);
  if (cos_p >= 0 && cos_q >= 0) {
    return true;
  }
  const double sin_p = pa.cross(pb).norm(), sin_q = qa.cross(qb).norm();
  const double scale = (sin_p + std::abs(cos_p)) * (sin_q + std::abs(cos_q));
  return sin_p * cos_q + cos_p * sin_q >= -angle_noise * scale;
}

/// Whether both triangles at the other diagonal pq face the side of the old triangles' area vector.
bool keeps_side(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const Vec3 before = double_area_vector(p, a, b) + double_area_vector(q, b, a);
  return double_area_vector(p, a, q).dot(before) > 0 && double_area_vector(q, b, p).dot(before) > 0;
}

/// Whether the patch may get the edge pq; t is a triangle at p.
bool may_join(const Patch& patch, Index t, Index p, Index q) {
  const bool across_discs = !patch.one_disc && p < patch.own_from && q < patch.own_from;
  return !across_discs && !patch.taken.contains(p, q) && !patch.net.joined(t, p, q);
}

}  // namespace

Index flip_to_delaunay(Patch& patch) {
  TriangleNet& net = patch.net;
  std::vector<NetEdge> waiting;
  for (Index t = 0; t < net.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (net.start({t, i}) < net.end({t, i})) {
        waiting.push_back({t, i});
      }
    }
  }
  Index flips = 0;
  const Index most_flips = 100 * net.size();  // in case rounding makes flips go on for ever
  while (!waiting.empty() && flips < most_flips) {
    const NetEdge e = waiting.back();
    waiting.pop_back();
    const NetEdge o = net.other_side(e);
    if (o.triangle < 0) {
      continue;
    }
    const Index p = net.opposite(e), q = net.opposite(o);
    const Vec3 xa = patch.X.row(net.start(e)), xb = patch.X.row(net.end(e));
    const Vec3 xp = patch.X.row(p), xq = patch.X.row(q);
    if (is_delaunay(xa, xb, xp, xq) || !keeps_side(xa, xb, xp, xq) ||
        !may_join(patch, e.triangle, p, q)) {
      continue;
    }
    net.flip(e);
    ++flips;
    for (const Index t : {e.triangle, o.triangle}) {
      for (int i = 0; i < 3; ++i) {
        waiting.push_back({t, i});
      }
    }
  }
  return flips;
}

}  // namespace ibmfair
