#include "ibmfair/energy/lagrange.h"

#include <array>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/complete_stars.h"
#include "ibmfair/energy/lagrange_kernels.h"

namespace ibmfair {
namespace {

std::vector<std::uint8_t> is_centre(const CompressedRows& stencils, Index vertex_count) {
  std::vector<std::uint8_t> centre(static_cast<std::size_t>(vertex_count), 0);
  for (Index s = 0; s < stencils.size(); ++s) {
    centre[stencils[s][0]] = 1;
  }
  return centre;
}

std::vector<std::uint8_t> triangles_around(const Topology& topology,
                                           const std::vector<std::uint8_t>& centre) {
  std::vector<std::uint8_t> around(static_cast<std::size_t>(topology.F.rows()), 0);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    const auto x = topology.F.row(t);
    around[t] = topology.usable[t] && (centre[x[0]] || centre[x[1]] || centre[x[2]]);
  }
  return around;
}

FanFrame* frames_for(const MeshBlock& b, std::vector<FanFrame>& frames) {
  const FanGroup& last = b.fans.back();
  const auto count = static_cast<std::size_t>(last.first_row + last.triangles + 1);
  if (frames.size() < count) {
    frames.resize(count);
  }
  return frames.data();
}

/// The roles of one block's vertices; `centre` and `own` are #V, and `own` may be empty for all.
VertexRoles roles_in(const MeshBlocks& blocks, const MeshBlock& b,
                     const std::vector<std::uint8_t>& centre,
                     const std::vector<std::uint8_t>& own) {
  VertexRoles roles;
  for (const Index v : blocks.owned_of(b)) {
    const bool counts = centre[v] && (own.empty() || own[v]);
    roles.carries.push_back(centre[v] ? -1 : 0);
    roles.counts.push_back(counts ? -1 : 0);
  }
  for (Index i = 0; i < b.rim; ++i) {
    roles.carries.push_back(centre[b.halo[i]] ? -1 : 0);
  }
  const std::size_t whole = (roles.carries.size() + fans_per_group - 1) / fans_per_group;
  roles.carries.resize(whole * fans_per_group, 0);
  roles.counts.resize(whole * fans_per_group, 0);
  return roles;
}

}  // namespace

Lagrange::Lagrange(const Topology& topology, const EnergyOptions& options)
    : mass_(options.mass),
      spontaneous_(options.spontaneous_curvature),
      stencils_(complete_stars(topology, options.active)) {
  const std::vector<std::uint8_t> centre = is_centre(stencils_, topology.vertex_count);
  blocks_ = mesh_blocks(topology, triangles_around(topology, centre), {.whole_stars = true});
  roles_.reserve(blocks_.block.size());
  for (const MeshBlock& b : blocks_.block) {
    roles_.push_back(roles_in(blocks_, b, centre, options.own_vertices));
  }
}

void Lagrange::load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const {
  blocks_.load(b, X, vertices);
  if (is_spontaneous()) {
    blocks_.load(b, spontaneous_, vertices);
  }
}

const VertexRoles& Lagrange::roles(const MeshBlock& b) const {
  return roles_[&b - blocks_.block.data()];
}

double Lagrange::energy(const Points& X) {
  return loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    BlockVertices& vertices = scratch.vertices;
    load(b, X, vertices);
    std::array<FanFrame, longest_fan + 1> frames;
    lagrange_curvature(blocks_.fetching_next(b, b.groups, X), is_spontaneous(), false,
                       vertices.data(), frames.data());
    return lagrange_energy(roles(b), b.owned, mass_, &vertices[filler_vertices]);
  });
}

double Lagrange::energy_and_gradient(const Points& X, Points& G) {
  blocks_.prepare(G);
  return loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    BlockVertices& vertices = scratch.vertices;
    load(b, X, vertices);
    FanFrame* frames = frames_for(b, scratch.frames);
    lagrange_curvature(blocks_.fetching_sums(b, b.outer_groups, G), is_spontaneous(), true,
                       vertices.data(), frames);
    const double E = lagrange_energy_and_y(roles(b), b.owned + b.rim, mass_, is_spontaneous(),
                                           &vertices[filler_vertices]);
    lagrange_forces(blocks_.fetching_next(b, b.groups, X), is_spontaneous(), vertices.data(),
                    frames);
    blocks_.store(b, vertices, G);
    return E;
  });
}

void Lagrange::linearise(const Points& X, StencilWeights& weights) {
  weights.c.resize(static_cast<Eigen::Index>(stencils_.value.size()));
  weights.w.resize(stencils_.size());
  parallel_for(stencils_.size(), [&](std::int64_t s) {
    const auto star = stencils_[static_cast<Index>(s)];
    const auto ring = star.subspan(1);
    double* c = &weights.c[stencils_.first[s]];
    std::fill_n(c, star.size(), 0.0);
    const Vec3 v = X.row(star[0]);
    double area = 0;
    Vec3 a = X.row(ring[0]);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t next = k + 1 < ring.size() ? k + 1 : 0;
      const Vec3 b = X.row(ring[next]);
      const Vec3 va = a - v, vb = b - v, ab = b - a;
      const double double_area = va.cross(vb).norm();
      const double half = 0.5 / double_area;
      const double cot_a = -va.dot(ab) * half, cot_b = vb.dot(ab) * half;  // half the cotangents
      c[1 + k] -= cot_b;  // L_va = -(cot b + ...) / 2
      c[1 + next] -= cot_a;
      c[0] += cot_a + cot_b;
      area += double_area / 2;
      a = b;
    }
    weights.w[s] = mass_ ? 3 / area : 1;
  });
}

}  // namespace ibmfair
