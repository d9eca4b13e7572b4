#include "ibmfair/energy/vertex_energy.h"

#include <span>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/complete_stars.h"
#include "ibmfair/energy/consistent_mass.h"

namespace ibmfair {
namespace {

std::vector<Index> first_of(const CompressedRows& rows) {
  std::vector<Index> first;
  first.reserve(static_cast<std::size_t>(rows.size()));
  for (Index i = 0; i < rows.size(); ++i) {
    first.push_back(rows[i][0]);
  }
  return first;
}

std::vector<std::uint8_t> usable_triangles_at(const Topology& topology,
                                              const std::vector<Index>& nodes) {
  std::vector<std::uint8_t> at(static_cast<std::size_t>(topology.F.rows()), 0);
  for (const Index v : nodes) {
    for (const Index t : topology.stars[v]) {
      at[t] = topology.usable[t];
    }
  }
  return at;
}

/// Whether each vertex has its own term of the energy, which depends only on the vertex's ring.
bool summed_separately(const VertexLaplacian& laplacian, const MassMatrix& mass) {
  return !laplacian.flips && mass.kind != MassMatrix::Kind::consistent;
}

}  // namespace

VertexEnergy::VertexEnergy(const Topology& topology, const EnergyOptions& options,
                           const VertexLaplacian& laplacian, const MassMatrix& mass)
    : mass_(mass.kind),
      stencils_(complete_stars(topology, summed_separately(laplacian, mass)
                                             ? options.active
                                             : std::vector<std::uint8_t>{})),
      nodes_(first_of(stencils_)),
      own_vertices_(options.own_vertices),
      triangles_(topology, laplacian, mass, options, usable_triangles_at(topology, nodes_)),
      h_(Points::Zero(topology.vertex_count, 3)),
      y_(h_),
      m_(PerVertex::Ones(topology.vertex_count)) {}

double VertexEnergy::energy(const Points& X) {
  triangles_.measure(X);
  const auto count = static_cast<std::int64_t>(nodes_.size());
  parallel_for(count, [&](std::int64_t u) {
    const Index v = nodes_[u];
    Vec3 h = Vec3::Zero();
    double m = 0;
    triangles_.around(v, [&](Index t, int i) {
      const int j = next(i), k = previous(i);
      const auto& [edge, corner] = triangles_.terms()[t];
      h += edge[k] * (X.row(v) - X.row(triangles_.corners()(t, j)));
      h += edge[j] * (X.row(v) - X.row(triangles_.corners()(t, k)));
      m += corner[i];
    });
    h_.row(v) = h;
    m_[v] = mass_ == MassMatrix::Kind::identity ? 1 : m;
    y_.row(v) = h_.row(v) / m_[v];
  });
  if (mass_ == MassMatrix::Kind::consistent) {
    solve_consistent_mass(triangles_, nodes_, m_, h_, y_);
  }
  return parallel_sum(count, [&](std::int64_t u) {
    const Index v = nodes_[u];
    const bool own = own_vertices_.empty() || own_vertices_[v] != 0;
    return own ? h_.row(v).dot(y_.row(v)) / 2 : 0;
  });
}

/// The derivatives of E with respect to the contributions of triangle t to L and to M.
TriangleTerms VertexEnergy::by_terms(Index t, const Points& X) const {
  TriangleTerms by{};
  const auto x = triangles_.corners().row(t);
  for (int i = 0; i < 3; ++i) {
    const Index a = x[next(i)], b = x[previous(i)];
    by.edge[i] = (y_.row(a) - y_.row(b)).dot(X.row(a) - X.row(b));
    by.corner[i] = mass_ == MassMatrix::Kind::lumped ? -y_.row(x[i]).squaredNorm() / 2 : 0;
  }
  if (mass_ == MassMatrix::Kind::consistent) {  // the shares of the corners add up to the area
    by.corner.fill(-consistent_mass_slope(y_.row(x[0]), y_.row(x[1]), y_.row(x[2])));
  }
  return by;
}

double VertexEnergy::energy_and_gradient(const Points& X, Points& G) {
  const double E = energy(X);
  slopes_.resize(triangles_.terms().size());
  parallel_for(triangles_.corners().rows(), [&](std::int64_t i) {
    const auto t = static_cast<Index>(i);
    slopes_[t] = triangles_.slopes(t, by_terms(t, X));
  });
  G.resize(X.rows(), 3);
  parallel_for(X.rows(), [&](std::int64_t i) {  // L y
    const auto v = static_cast<Index>(i);
    Vec3 g = Vec3::Zero();
    triangles_.around(v, [&](Index t, int corner) {
      const int j = next(corner), k = previous(corner);
      const ByCorner<double>& edge = triangles_.terms()[t].edge;
      g += edge[k] * (y_.row(v) - y_.row(triangles_.corners()(t, j)));
      g += edge[j] * (y_.row(v) - y_.row(triangles_.corners()(t, k)));
    });
    G.row(v) = g;
  });
  triangles_.pull_back(X, slopes_, G);
  return E;
}

PerVertex VertexEnergy::energy_by_vertex(const Points& X) {
  energy(X);
  return h_.cwiseProduct(y_).rowwise().sum() / 2;
}

void VertexEnergy::linearise(const Points& X, StencilWeights& weights) {
  weights.c.setZero(static_cast<Eigen::Index>(stencils_.value.size()));
  weights.w.resize(static_cast<Eigen::Index>(nodes_.size()));
  triangles_.measure(X);
  parallel_for(stencils_.size(), [&](std::int64_t s) {
    const auto star = stencils_[static_cast<Index>(s)];
    double* c = &weights.c[stencils_.first[s]];
    double m = 0;
    for (std::size_t k = 1; k < star.size(); ++k) {
      const std::size_t l = k + 1 < star.size() ? k + 1 : 1;
      const auto [edge, corner] = triangles_.terms_of(X, star[0], star[k], star[l]);
      c[k] -= edge[2];
      c[l] -= edge[1];
      c[0] += edge[1] + edge[2];
      m += corner[0];
    }
    weights.w[s] = mass_ == MassMatrix::Kind::identity     ? 1
                   : mass_ == MassMatrix::Kind::consistent ? 2 / m
                                                           : 1 / m;
  });
}

}  // namespace ibmfair
