#include "ibmfair/energy/intrinsic_delaunay.h"

#include <cmath>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/vertex_triangles.h"
#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

/// Relative to the cotangents: smaller sums of two cotangents are rounding errors. Without this
/// tolerance, cocircular points would flip for ever.
constexpr double cocircular = 1e-12;

constexpr std::size_t most_flips_per_edge = 100;  // rounding errors must not make the loop endless

}  // namespace

IntrinsicDelaunay::IntrinsicDelaunay(const Topology& topology)
    : mesh_corners_(usable_triangles(topology)),
      mesh_sides_(usable_sides(topology)),
      mesh_places_(static_cast<std::size_t>(topology.E.rows()), Sides{-1, -1}),
      mesh_twisted_(mesh_places_.size(), 0) {
  for (Index t = 0; t < mesh_sides_.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      Sides& places = mesh_places_[mesh_sides_(t, i)];
      places[places[0] < 0 ? 0 : 1] = 3 * t + i;
    }
  }
  for (Index e = 0; e < topology.E.rows(); ++e) {
    Sides& places = mesh_places_[e];
    if (topology.edge_triangles[e].size() == 2 && places[1] >= 0) {
      const Index a = topology.E(e, 0), b = topology.E(e, 1);
      mesh_twisted_[e] = runs_along(mesh_corners_, places[0] / 3, a, b) ==
                         runs_along(mesh_corners_, places[1] / 3, a, b);
    } else {
      places = {-1, -1};  // never flips
    }
  }
}

void IntrinsicDelaunay::triangulate(const Points& X) {
  corners_ = mesh_corners_;
  sides_ = mesh_sides_;
  places_ = mesh_places_;
  twisted_ = mesh_twisted_;
  flips_.clear();
  shapes_.resize(static_cast<std::size_t>(corners_.rows()));
  parallel_for(corners_.rows(), [&](std::int64_t t) {
    shapes_[t] =
        triangle_shape(X.row(corners_(t, 0)), X.row(corners_(t, 1)), X.row(corners_(t, 2)));
  });
  std::vector<Index> waiting;
  for (std::size_t e = places_.size(); e-- > 0;) {
    if (!is_delaunay(static_cast<Index>(e))) {
      waiting.push_back(static_cast<Index>(e));
    }
  }
  while (!waiting.empty() && flips_.size() < most_flips_per_edge * places_.size()) {
    const Index e = waiting.back();
    waiting.pop_back();
    if (!is_delaunay(e)) {
      flip(e, waiting);
    }
  }
}

bool IntrinsicDelaunay::is_delaunay(Index e) const {
  const auto [s, o] = places_[e];
  if (s < 0 || s / 3 == o / 3) {  // an edge whose two sides belong to one triangle is Delaunay
    return true;
  }
  const double a = shapes_[s / 3].cot[s % 3], b = shapes_[o / 3].cot[o % 3];
  return !(a + b < -cocircular * (std::abs(a) + std::abs(b)));
}

/// For an edge that never flips, returns a place that is never read.
Index& IntrinsicDelaunay::side_at(Index e, Index place) {
  return places_[e][0] == place ? places_[e][0] : places_[e][1];
}

void IntrinsicDelaunay::reverse(Index t) {
  Index &first = side_at(sides_(t, 1), 3 * t + 1), &second = side_at(sides_(t, 2), 3 * t + 2);
  first = 3 * t + 2;
  second = 3 * t + 1;
  for (int i = 0; i < 3; ++i) {
    twisted_[sides_(t, i)] ^= 1;
  }
  std::swap(corners_(t, 1), corners_(t, 2));
  std::swap(sides_(t, 1), sides_(t, 2));
  std::swap(shapes_[t].cot[1], shapes_[t].cot[2]);
  std::swap(shapes_[t].squared[1], shapes_[t].squared[2]);
}

void IntrinsicDelaunay::flip(Index e, std::vector<Index>& waiting) {
  if (twisted_[e]) {
    reverse(places_[e][1] / 3);
  }
  // Triangles p a b and q b a become p a q and q b p. The quadrilateral is laid out in the plane:
  // the old diagonal starts at a and runs along the first axis, p lies above it and q below.
  const Index t = places_[e][0] / 3, u = places_[e][1] / 3;
  const int p = places_[e][0] % 3, a = next(p), b = previous(p);
  const int q = places_[e][1] % 3, b_u = next(q), a_u = previous(q);
  const TriangleShape<double> above = shapes_[t], below = shapes_[u];
  const double diagonal = std::sqrt(above.squared[p]);
  const double h_p = 2 * above.area / diagonal, h_q = 2 * below.area / diagonal;
  const double x_p = above.cot[a] * h_p, x_q = below.cot[a_u] * h_q;  // measured from a
  const double z_p = above.cot[b] * h_p, z_q = below.cot[b_u] * h_q;  // measured backwards from b
  const double area_a = (x_p * h_q + x_q * h_p) / 2, area_b = (z_p * h_q + z_q * h_p) / 2;
  if (!(area_a > 0 && area_b > 0)) {  // the quadrilateral is convex except for rounding errors
    return;
  }
  const double along = x_p - x_q, across = h_p + h_q;
  const double new_squared = along * along + across * across;

  const Index pa = sides_(t, b), pb = sides_(t, a), qa = sides_(u, b_u), qb = sides_(u, a_u);
  const double to_p = area_b / above.area, to_q = area_b / below.area;
  const double from_p = area_a / above.area, from_q = area_a / below.area;
  // The squared distances between four points of a plane satisfy sum of s_ij d l_ij^2 = 0 for any
  // motion of the points, where s_ij = c_i c_j and c is the affine dependency of the points: the
  // signed areas of the triangles opposite to them.
  flips_.push_back({{e, pa, pb, qa, qb}, {-to_p * from_q, to_p, from_p, to_q, from_q}});

  const auto cot = [](double dot, double area) { return dot / (2 * area); };
  const TriangleShape<double> at_a{
      {below.squared[b_u], new_squared, above.squared[b]},
      {cot(x_p * along + h_p * across, area_a), cot(x_p * x_q - h_p * h_q, area_a),
       cot(h_q * across - x_q * along, area_a)},
      area_a,
      {}};
  const TriangleShape<double> at_b{
      {above.squared[a], new_squared, below.squared[a_u]},
      {cot(h_q * across + z_q * along, area_b), cot(z_p * z_q - h_p * h_q, area_b),
       cot(h_p * across - z_p * along, area_b)},
      area_b,
      {}};
  const Index vertex_p = corners_(t, p), vertex_a = corners_(t, a), vertex_b = corners_(t, b),
              vertex_q = corners_(u, q);
  Index &place_pa = side_at(pa, 3 * t + b), &place_pb = side_at(pb, 3 * t + a),
        &place_qa = side_at(qa, 3 * u + b_u), &place_qb = side_at(qb, 3 * u + a_u);
  corners_.row(t) << vertex_p, vertex_a, vertex_q;
  corners_.row(u) << vertex_q, vertex_b, vertex_p;
  sides_.row(t) << qa, e, pa;
  sides_.row(u) << pb, e, qb;
  place_qa = 3 * t;
  place_pa = 3 * t + 2;
  place_pb = 3 * u;
  place_qb = 3 * u + 2;
  places_[e] = {3 * t + 1, 3 * u + 1};
  shapes_[t] = at_a;
  shapes_[u] = at_b;
  waiting.insert(waiting.end(), {pa, pb, qa, qb});
}

void IntrinsicDelaunay::pull_back(std::vector<double>& by_squared) const {
  for (std::size_t last = flips_.size(); last-- > 0;) {
    const auto& flip = flips_[last];
    const double by_new = by_squared[flip.edge[0]];
    by_squared[flip.edge[0]] = 0;
    for (int i = 0; i < 5; ++i) {
      by_squared[flip.edge[i]] += flip.slope[i] * by_new;
    }
  }
}

}  // namespace ibmfair
