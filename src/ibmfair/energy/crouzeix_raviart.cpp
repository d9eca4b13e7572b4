#include "ibmfair/energy/crouzeix_raviart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/crouzeix_raviart_kernels.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

bool touches(const std::vector<std::uint8_t>& active, std::span<const Index> vertices) {
  return active.empty() ||
         std::any_of(vertices.begin(), vertices.end(), [&](Index v) { return active[v] != 0; });
}

/// The hinges that contain an active vertex.
std::vector<Index> active_hinges(const Topology& topology,
                                 const std::vector<std::uint8_t>& active) {
  return indices_where(topology.H.rows(), [&](Index h) {
    return touches(active, {topology.H.row(h).data(), 4});
  });
}

CompressedRows rows_of_four(const Hinges& H, const std::vector<Index>& hinges) {
  const auto count = static_cast<std::int64_t>(hinges.size());
  CompressedRows rows;
  rows.first.assign(hinges.size() + 1, 0);
  rows.value.resize(4 * hinges.size());
  parallel_for(count, [&](std::int64_t i) {
    rows.first[i + 1] = 4 * (i + 1);
    std::copy_n(H.row(hinges[i]).data(), 4, &rows.value[4 * i]);
  });
  return rows;
}

/// Blocks of the triangles of the hinges, with the adjacency of triangles across hinges.
MeshBlocks hinge_blocks(const Topology& topology, const std::vector<Index>& hinges,
                        const std::vector<std::uint8_t>& counted) {
  const auto triangles = static_cast<std::size_t>(topology.F.rows());
  Neighbours neighbours(3 * triangles, no_triangle);
  parallel_for(static_cast<std::int64_t>(hinges.size()), [&](std::int64_t i) {
    const Index h = hinges[i];
    const auto x = topology.H.row(h);
    const Index t0 = topology.hinge_triangles(h, 0), t1 = topology.hinge_triangles(h, 1);
    const bool agree = runs_along(topology.F, t1, x[1], x[0]);
    neighbours[3 * std::size_t(t0) + place_of(topology.F, t0, x[2])] = agree ? t1 : ~t1;
    neighbours[3 * std::size_t(t1) + place_of(topology.F, t1, x[3])] = agree ? t0 : ~t0;
  });
  std::vector<std::uint8_t> kept(triangles);
  parallel_for(static_cast<std::int64_t>(triangles), [&](std::int64_t t) {
    const Index* beside = &neighbours[3 * t];
    kept[t] = std::any_of(beside, beside + 3, [](Index other) { return other != no_triangle; });
  });
  return mesh_blocks(topology, kept, {.neighbours = std::move(neighbours)}, counted);
}

/// 1 / the bound u0: the energy 3 |e|^2 / A (1 + cos theta) of a hinge of equilateral triangles
/// that turns by the angle. 0 for no bound.
double inverse_bound(double sharp_angle) {
  const double equilateral = 2 * std::sqrt(3.0);  // 3 |e|^2 / A
  return sharp_angle > 0 ? 1 / (equilateral * (1 - std::cos(sharp_angle))) : 0;
}

}  // namespace

CrouzeixRaviart::CrouzeixRaviart(const Topology& topology, const EnergyOptions& options)
    : terms_{options.mass, inverse_bound(options.sharp_angle)} {
  const std::vector<Index> hinges = active_hinges(topology, options.active);
  stencils_ = rows_of_four(topology.H, hinges);
  blocks_ = hinge_blocks(topology, hinges, options.own_triangles);
  turns_.resize(blocks_.block.size());
}

double CrouzeixRaviart::block_energy(const MeshBlock& b, const Points& X, const Points* G,
                                     BlockScratch& scratch) {
  blocks_.load(b, X, scratch.vertices);
  const FanGroup& last = b.fans.back();
  const auto triangles =
      static_cast<std::size_t>(fans_per_group * (last.first_row + last.triangles)) +
      1;  // gather() reads beyond the last
  if (scratch.triangles.size() < triangles) {
    scratch.triangles.resize(triangles);
  }
  BlockVertex* vertices = scratch.vertices.data();
  Row4* frames = scratch.triangles.data();
  crouzeix_raviart_frames(
      G != nullptr ? blocks_.fetching_sums(b, b.outer_groups, *G) : BlockPass{b, b.outer_groups},
      vertices, frames);
  const HingeSums sums = crouzeix_raviart_hinges(blocks_.fetching_next(b, b.groups, X), terms_,
                                                 G != nullptr, vertices, frames);
  turns_[&b - blocks_.block.data()] = sums.max_dihedral_turn;
  return sums.energy;
}

double CrouzeixRaviart::max_dihedral_turn() const {
  return turns_.empty() ? 0 : *std::max_element(turns_.begin(), turns_.end());
}

/// Each hinge is evaluated in every block that owns one of its vertices, so flagging the owned
/// vertices of a block suffices.
std::vector<std::uint8_t> CrouzeixRaviart::near_turns(double turn) const {
  std::vector<std::uint8_t> near(blocks_.owned.size() + blocks_.untouched.size(), 0);
  for (std::size_t b = 0; b < turns_.size(); ++b) {
    if (turns_[b] >= turn) {
      for (const Index v : blocks_.owned_of(blocks_.block[b])) {
        near[v] = 1;
      }
    }
  }
  return near;
}

double CrouzeixRaviart::energy(const Points& X) {
  return loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    return block_energy(b, X, nullptr, scratch);
  });
}

double CrouzeixRaviart::energy_and_gradient(const Points& X, Points& G) {
  blocks_.prepare(G);
  return loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    const double E = block_energy(b, X, &G, scratch);
    blocks_.store(b, scratch.vertices, G);
    return E;
  });
}

void CrouzeixRaviart::linearise(const Points& X, StencilWeights& weights) {
  weights.c.resize(static_cast<Eigen::Index>(stencils_.value.size()));
  weights.w.resize(stencils_.size());
  parallel_for(stencils_.size(), [&](std::int64_t h) {
    const Index* x = &stencils_.value[4 * h];
    const Vec3 x0 = X.row(x[0]), x1 = X.row(x[1]), x2 = X.row(x[2]), x3 = X.row(x[3]);
    const Vec3 e0 = x1 - x0;
    const Vec3 N0 = double_area_vector(x0, x1, x2), N1 = double_area_vector(x1, x0, x3);
    const double double_area0 = N0.norm(), double_area1 = N1.norm();
    // Cotangents of the angles between e0 and the other edges at x0 and at x1: [W07] Figure 10.
    const double a01 = e0.dot(x2 - x0) / double_area0, a02 = e0.dot(x3 - x0) / double_area1;
    const double a03 = e0.dot(x1 - x2) / double_area0, a04 = e0.dot(x1 - x3) / double_area1;
    double* c = &weights.c[4 * h];  // [W07] Theorem 3
    c[0] = a03 + a04;
    c[1] = a01 + a02;
    c[2] = -a01 - a03;
    c[3] = -a02 - a04;
    weights.w[h] = terms_.mass ? 6 / (double_area0 + double_area1) : 1;
    if (terms_.inverse_bound > 0) {
      const double s = (N0 / double_area0 - N1 / double_area1).squaredNorm() / 2;
      const double u = weights.w[h] * e0.squaredNorm() * s;
      weights.w[h] /= std::pow(1 + u * terms_.inverse_bound, 2);
    }
  });
}

}  // namespace ibmfair
