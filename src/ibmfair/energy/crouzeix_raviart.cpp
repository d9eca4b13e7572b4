#include "ibmfair/energy/crouzeix_raviart.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/incidence.h"
#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

/// Cotangents of the angles between the edge e0 = (x0,x1) and the four others: [W07] Figure 10.
struct Cotangents {
  double a01, a02;  // at x0, in the first and second triangle
  double a03, a04;  // at x1
};

Cotangents cotangents(const Points& X, const Index* x, double area0, double area1) {
  const Vec3 x0 = X.row(x[0]), x1 = X.row(x[1]), x2 = X.row(x[2]), x3 = X.row(x[3]);
  const Vec3 e0 = x1 - x0;
  return {e0.dot(x2 - x0) / (2 * area0), e0.dot(x3 - x0) / (2 * area1),
          e0.dot(x1 - x2) / (2 * area0), e0.dot(x1 - x3) / (2 * area1)};
}

bool touches(const std::vector<std::uint8_t>& active, std::span<const Index> vertices) {
  return active.empty() ||
         std::any_of(vertices.begin(), vertices.end(), [&](Index v) { return active[v] != 0; });
}

}  // namespace

CrouzeixRaviart::CrouzeixRaviart(const Topology& topology, const EnergyOptions& options)
    : mass_(options.mass) {
  std::vector<Index> hinges;
  for (Index h = 0; h < topology.H.rows(); ++h) {
    const std::span<const Index> x(topology.H.row(h).data(), 4);
    if (touches(options.active, x)) {
      hinges.push_back(h);
      stencils_.value.insert(stencils_.value.end(), x.begin(), x.end());
      stencils_.first.push_back(static_cast<std::int64_t>(stencils_.value.size()));
    }
  }
  places_ = places_by_vertex(stencils_, topology.vertex_count);

  std::vector<Index> local(static_cast<std::size_t>(topology.F.rows()), -1);
  std::vector<Index> triangles;
  triangles_.resize(stencils_.size(), 2);
  turn_.resize(hinges.size());
  for (Index h = 0; h < stencils_.size(); ++h) {
    for (int side = 0; side < 2; ++side) {
      const Index t = topology.hinge_triangles(hinges[h], side);
      if (local[t] < 0) {
        local[t] = static_cast<Index>(triangles.size());
        triangles.push_back(t);
      }
      triangles_(h, side) = local[t];
    }
    const auto x = topology.H.row(hinges[h]);
    const Index second = topology.hinge_triangles(hinges[h], 1);
    turn_[h] = runs_along(topology.F, second, x[1], x[0]) ? 1 : -1;
  }
  F_ = topology.F(triangles, Eigen::all);
  triangle_.resize(triangles.size());
  forces_.resize(hinges.size());
}

double CrouzeixRaviart::hinge_energy(const Points& X, Index h) const {
  const Index* x = &stencils_.value[4 * std::size_t(h)];
  const TriangleFrame& t0 = triangle_[triangles_(h, 0)];
  const TriangleFrame& t1 = triangle_[triangles_(h, 1)];
  const double e0_squared = (X.row(x[1]) - X.row(x[0])).squaredNorm();
  // 1 + cos(theta) by this difference keeps its digits near flat hinges, where the sum loses them.
  const double s = (t0.normal - turn_[h] * t1.normal).squaredNorm() / 2;
  return (mass_ ? 3 / (t0.area + t1.area) : 1) * e0_squared * s;
}

CrouzeixRaviart::Forces CrouzeixRaviart::hinge_gradient(const Points& X, Index h) const {
  const Index* x = &stencils_.value[4 * std::size_t(h)];
  const Vec3 x0 = X.row(x[0]), x1 = X.row(x[1]), x2 = X.row(x[2]), x3 = X.row(x[3]);
  const Vec3 e0 = x1 - x0;
  const double e0_squared = e0.squaredNorm();
  const double area0 = triangle_[triangles_(h, 0)].area, area1 = triangle_[triangles_(h, 1)].area;
  const Vec3 n0 = triangle_[triangles_(h, 0)].normal;
  const Vec3 n1 = turn_[h] * triangle_[triangles_(h, 1)].normal;
  const auto [a01, a02, a03, a04] = cotangents(X, x, area0, area1);
  const double A = area0 + area1;
  const double k = mass_ ? 3 / A : 1;
  const double s = (n0 - n1).squaredNorm() / 2;

  // Bending part, [W07] (15) f^B: -sin(theta) = <e0, n1 x n0> / |e0|, by the small difference.
  const double r = k * e0.dot((n1 - n0).cross(n0));
  Forces g{-r * (a03 * n0 + a04 * n1), -r * (a01 * n0 + a02 * n1),
           r * e0_squared / (2 * area0) * n0, r * e0_squared / (2 * area1) * n1};

  // In-plane part, [W07] (15) f^P: the edge's length, then (with mass) the area below the line.
  g[0] -= 2 * k * s * e0;
  g[1] += 2 * k * s * e0;
  if (mass_) {
    const double p = -k / A * e0_squared * s / 2;  // the area's gradient is n x edge / 2
    g[0] += p * (n0.cross(x2 - x1) + n1.cross(x1 - x3));
    g[1] += p * (n0.cross(x0 - x2) + n1.cross(x3 - x0));
    g[2] += p * n0.cross(e0);
    g[3] -= p * n1.cross(e0);
  }
  return g;
}

double CrouzeixRaviart::energy(const Points& X) {
  update_frames(X, F_, triangle_);
  return parallel_sum(stencils_.size(),
                      [&](std::int64_t h) { return hinge_energy(X, static_cast<Index>(h)); });
}

double CrouzeixRaviart::energy_and_gradient(const Points& X, Points& G) {
  update_frames(X, F_, triangle_);
  const double E = parallel_sum(stencils_.size(), [&](std::int64_t h) {
    forces_[h] = hinge_gradient(X, static_cast<Index>(h));
    return hinge_energy(X, static_cast<Index>(h));
  });
  gather(places_, forces_, G);
  return E;
}

void CrouzeixRaviart::linearise(const Points& X, StencilWeights& weights) {
  update_frames(X, F_, triangle_);
  weights.c.resize(stencils_.value.size());
  weights.w.resize(forces_.size());
  parallel_for(stencils_.size(), [&](std::int64_t h) {
    const double area0 = triangle_[triangles_(h, 0)].area, area1 = triangle_[triangles_(h, 1)].area;
    const auto [a01, a02, a03, a04] = cotangents(X, &stencils_.value[4 * h], area0, area1);
    double* c = &weights.c[4 * h];  // [W07] Theorem 3
    c[0] = a03 + a04;
    c[1] = a01 + a02;
    c[2] = -a01 - a03;
    c[3] = -a02 - a04;
    weights.w[h] = mass_ ? 3 / (area0 + area1) : 1;
  });
}

}  // namespace ibmfair
