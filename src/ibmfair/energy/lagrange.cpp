#include "ibmfair/energy/lagrange.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/incidence.h"

namespace ibmfair {
namespace {

/// Interior vertices all of whose triangles may carry a stencil, and that matter.
std::vector<Index> complete_stars(const Topology& topology,
                                  const std::vector<std::uint8_t>& active) {
  std::vector<Index> centres;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    const auto star = topology.stars[v];
    const bool complete =
        topology.kind[v] == VertexKind::interior &&
        std::all_of(star.begin(), star.end(), [&](Index t) { return topology.usable[t] != 0; });
    const bool matters = active.empty() || std::any_of(star.begin(), star.end(), [&](Index t) {
                           const auto corner = topology.F.row(t);
                           return active[corner[0]] || active[corner[1]] || active[corner[2]];
                         });
    if (complete && matters) {
      centres.push_back(v);
    }
  }
  return centres;
}

}  // namespace

Lagrange::Lagrange(const Topology& topology, const EnergyOptions& options) : mass_(options.mass) {
  centre_ = complete_stars(topology, options.active);
  star_of_.assign(static_cast<std::size_t>(topology.vertex_count), -1);
  std::vector<Index> triangles;
  std::vector<Index> ring;
  for (Index s = 0; s < static_cast<Index>(centre_.size()); ++s) {
    star_of_[centre_[s]] = s;
    ring.clear();
    for (const Index t : topology.stars[centre_[s]]) {
      triangles.push_back(t);
      ring.insert(ring.end(), topology.F.row(t).begin(), topology.F.row(t).end());
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::erase(ring, centre_[s]);
    stencils_.value.push_back(centre_[s]);
    stencils_.value.insert(stencils_.value.end(), ring.begin(), ring.end());
    stencils_.first.push_back(static_cast<std::int64_t>(stencils_.value.size()));
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  F_ = topology.F(triangles, Eigen::all);

  Rows corners;
  corners.value.assign(F_.data(), F_.data() + F_.size());
  places_ = places_by_vertex(corners, topology.vertex_count);
  ring_places_.assign(corners.value.size(), {-1, -1});
  for (Index corner = 0; corner < static_cast<Index>(corners.value.size()); ++corner) {
    const Index t = corner / 3, i = corner % 3;
    if (const Index s = star_of_[F_(t, i)]; s >= 0) {
      for (int next = 1; next <= 2; ++next) {
        const auto members = stencils_[s];
        const auto it = std::lower_bound(members.begin() + 1, members.end(), F_(t, (i + next) % 3));
        ring_places_[corner][next - 1] =
            static_cast<Index>(stencils_.first[s] + (it - members.begin()));
      }
    }
  }
  triangle_.resize(triangles.size());
  forces_.resize(triangles.size());
  h_.resize(centre_.size());
  m_.resize(centre_.size());
}

void Lagrange::update_curvature(const Points& X) {
  update_frames(X, F_, triangle_);
  parallel_for(static_cast<std::int64_t>(centre_.size()), [&](std::int64_t s) {
    Vec3 h = Vec3::Zero();
    double area = 0;
    for (const Index place : places_[centre_[s]]) {
      const Index t = place / 3, i = place % 3;
      const Vec3 e = X.row(F_(t, (i + 2) % 3)) - X.row(F_(t, (i + 1) % 3));
      h += triangle_[t].normal.cross(e) / 2;
      area += triangle_[t].area;
    }
    h_[s] = h;
    m_[s] = mass_ ? area / 3 : 1;
  });
}

double Lagrange::star_energy(Index s) const {
  return h_[s].squaredNorm() / m_[s] / 2;
}

double Lagrange::energy(const Points& X) {
  update_curvature(X);
  return parallel_sum(static_cast<std::int64_t>(centre_.size()),
                      [&](std::int64_t s) { return star_energy(static_cast<Index>(s)); });
}

// dE = sum_v <y_v, d h_v> - 1/2 |y_v|^2 d m_v with y_v = h_v / m_v: the Hessian of the area applied
// to y, and the derivative of the mass.
void Lagrange::triangle_gradient(const Points& X, Index t) {
  const auto x = F_.row(t);
  std::array<Vec3, 3> y;
  double y_squared = 0;
  for (int i = 0; i < 3; ++i) {
    const Index s = star_of_[x[i]];
    y[i] = s >= 0 ? Vec3(h_[s] / m_[s]) : Vec3(Vec3::Zero());
    y_squared += y[i].squaredNorm();
  }
  const Vec3 x0 = X.row(x[0]), x1 = X.row(x[1]), x2 = X.row(x[2]);
  const Vec3 n = triangle_[t].normal;
  const Vec3 dN = (y[1] - y[0]).cross(x2 - x0) + (x1 - x0).cross(y[2] - y[0]);
  const Vec3 dn = (dN - n * n.dot(dN)) / (2 * triangle_[t].area);
  const double dm = mass_ ? y_squared / 6 : 0;
  const std::array<Vec3, 3> e{x2 - x1, x0 - x2, x1 - x0};
  for (int i = 0; i < 3; ++i) {
    forces_[t][i] =
        (dn.cross(e[i]) + n.cross(y[(i + 2) % 3] - y[(i + 1) % 3]) - dm * n.cross(e[i])) / 2;
  }
}

double Lagrange::energy_and_gradient(const Points& X, Points& G) {
  const double E = energy(X);
  parallel_for(F_.rows(), [&](std::int64_t t) { triangle_gradient(X, static_cast<Index>(t)); });
  gather(places_, forces_, G);
  return E;
}

void Lagrange::linearise(const Points& X, StencilWeights& weights) {
  update_curvature(X);
  weights.c.assign(stencils_.value.size(), 0);
  weights.w.resize(centre_.size());
  parallel_for(static_cast<std::int64_t>(centre_.size()), [&](std::int64_t s) {
    double* c = weights.c.data();
    const std::int64_t centre = stencils_.first[s];
    for (const Index place : places_[centre_[s]]) {
      const Index t = place / 3, i = place % 3;
      const Vec3 v = X.row(F_(t, i)), a = X.row(F_(t, (i + 1) % 3)), b = X.row(F_(t, (i + 2) % 3));
      const double cot_a = (v - a).dot(b - a) / (2 * triangle_[t].area);
      const double cot_b = (v - b).dot(a - b) / (2 * triangle_[t].area);
      c[ring_places_[place][0]] -= cot_b / 2;  // L_va = -(cot b + ...) / 2
      c[ring_places_[place][1]] -= cot_a / 2;
      c[centre] += (cot_a + cot_b) / 2;
    }
    weights.w[s] = 1 / m_[s];
  });
}

}  // namespace ibmfair
