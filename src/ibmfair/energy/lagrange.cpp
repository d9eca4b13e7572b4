#include "ibmfair/energy/lagrange.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/block_prefetch.h"
#include "ibmfair/energy/complete_stars.h"
#include "ibmfair/energy/lagrange_kernels.h"

namespace ibmfair {
namespace {

std::vector<std::uint8_t> is_centre(const Rows& stencils, Index vertex_count) {
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

}  // namespace

Lagrange::Lagrange(const Topology& topology, const EnergyOptions& options)
    : mass_(options.mass), stencils_(complete_stars(topology, options.active)) {
  const std::vector<std::uint8_t> centre = is_centre(stencils_, topology.vertex_count);
  blocks_ = mesh_blocks(topology, triangles_around(topology, centre));
  carries_.reserve(blocks_.owned.size());
  counts_.reserve(blocks_.owned.size());
  for (const Index v : blocks_.owned) {
    carries_.push_back(centre[v]);
    counts_.push_back(centre[v] && (options.own_vertices.empty() || options.own_vertices[v]));
  }
  if (options.spontaneous_curvature.size() > 0) {
    spontaneous_.reserve(blocks_.owned.size());
    for (const Index v : blocks_.owned) {
      spontaneous_.push_back(options.spontaneous_curvature[v]);
    }
  }
}

void Lagrange::load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const {
  blocks_.load(b, X, vertices);
  if (!spontaneous_.empty()) {
    blocks_.load(b, spontaneous_, vertices);
  }
}

/// The energy of the block's own vertices; y, if given, has the place of the first.
double Lagrange::block_curvature(const MeshBlock& b, const Points& X, BlockScratch& scratch,
                                 BlockRow* y) {
  load(b, X, scratch.vertices);
  const Index* corners = b.corners.data();
  compute_and_prefetch(blocks_, b, b.groups, {X}, [&](std::int64_t first, std::int64_t groups) {
    lagrange_curvature(corners + first * 3 * lanes_per_group, groups, !spontaneous_.empty(),
                       scratch.vertices.data());
  });
  double E = 0;
  for (Index i = 0; i < b.owned; ++i) {
    const BlockRow& h = scratch.vertices[filler_vertices + i].sum;
    const bool carries = carries_[b.first_owned + i] != 0;
    const double inverse = mass_ ? 3 / h.w : 1;
    const BlockRow row{h.x * inverse, h.y * inverse, h.z * inverse, 0};
    const double energy = (h.x * row.x + h.y * row.y + h.z * row.z) / 2;
    E += counts_[b.first_owned + i] != 0 ? energy : 0;
    if (y != nullptr) {
      const double q = mass_ ? (row.x * row.x + row.y * row.y + row.z * row.z) / 6 : 0;
      y[i] = carries ? BlockRow{row.x, row.y, row.z, q} : BlockRow{};
    }
  }
  return E;
}

double Lagrange::energy(const Points& X) {
  return loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    return block_curvature(b, X, scratch, nullptr);
  });
}

double Lagrange::energy_and_gradient(const Points& X, Points& G) {
  y_.resize(blocks_.owned.size());
  const double E = loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    return block_curvature(b, X, scratch, &y_[b.first_owned]);
  });
  blocks_.prepare(G);
  loop_.sum(blocks_, [&](const MeshBlock& b, BlockScratch& scratch) {
    load(b, X, scratch.vertices);
    blocks_.load(b, y_, scratch.vertices);
    const Index* corners = b.corners.data();
    const auto add_forces = [&](std::int64_t first, std::int64_t groups) {
      lagrange_forces(corners + first * 3 * lanes_per_group, groups, !spontaneous_.empty(),
                      scratch.vertices.data());
    };
    compute_and_prefetch(blocks_, b, b.groups, {X, &y_, &G}, add_forces);
    blocks_.store(b, scratch.vertices, G);
    return 0.0;
  });
  return E;
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
