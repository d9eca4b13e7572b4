#include "ibmfair/fill/least_area.h"

#include <algorithm>
#include <array>
#include <vector>

#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/fill/patch_bound.h"
#include "ibmfair/fill/refine.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair {
namespace {

constexpr int least_steps = 3, most_steps = 100;
constexpr double settled = 1e-6;     // decrease of the area in a step, relative
constexpr double least_sine = 1e-9;  // of a triangle's angles: bounds its cotangents

/// Half the cotangents of the angles of triangle t, one for each corner.
std::array<double, 3> half_cotangents(const Patch& patch, Index t) {
  std::array<double, 3> result{};
  for (int i = 0; i < 3; ++i) {
    const Vec3 x = patch.X.row(patch.net[t][i]);
    const Vec3 a = patch.X.row(patch.net[t][(i + 1) % 3]).transpose() - x;
    const Vec3 b = patch.X.row(patch.net[t][(i + 2) % 3]).transpose() - x;
    const double sine = std::max(a.cross(b).norm(), least_sine * a.norm() * b.norm());
    result[i] = sine > 0 ? a.dot(b) / sine / 2 : 0;
  }
  return result;
}

/// An entry of the Dirichlet energy's Hessian: the weight of the edge from an own vertex.
struct EdgeWeight {
  Index from, to;
  double weight;
};

/// The weights of the edges at own vertices, from both sides, sorted by their ends.
std::vector<EdgeWeight> edge_weights(const Patch& patch) {
  std::vector<EdgeWeight> edges;
  for (Index t = 0; t < patch.net.size(); ++t) {
    const std::array<double, 3> weight = half_cotangents(patch, t);
    for (int i = 0; i < 3; ++i) {
      const Index a = patch.net.start({t, i}), b = patch.net.end({t, i});
      for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}}) {
        if (from >= patch.own_from) {
          edges.push_back({from, to, weight[i]});
        }
      }
    }
  }
  std::ranges::stable_sort(edges, [](const EdgeWeight& x, const EdgeWeight& y) {
    return std::array{x.from, x.to} < std::array{y.from, y.to};
  });
  std::vector<EdgeWeight> sums;
  for (const EdgeWeight& edge : edges) {
    if (!sums.empty() && sums.back().from == edge.from && sums.back().to == edge.to) {
      sums.back().weight += edge.weight;
    } else {
      sums.push_back(edge);
    }
  }
  return sums;
}

/// One step: the minimum of the Dirichlet energy over the present surface. Its area is not larger.
void minimise_dirichlet_energy(Patch& patch) {
  const std::vector<EdgeWeight> edges = edge_weights(patch);
  Points residual = Points::Zero(patch.own_size(), 3);
  SymmetricMatrix L;
  auto edge = edges.begin();
  for (Index v = patch.own_from; v < patch.size(); ++v) {
    const std::size_t diagonal = L.row.size();
    L.row.push_back(v - patch.own_from);
    L.value.push_back(0);
    for (; edge != edges.end() && edge->from == v; ++edge) {
      L.value[diagonal] += edge->weight;
      residual.row(v - patch.own_from) += edge->weight * (patch.X.row(v) - patch.X.row(edge->to));
      if (edge->to > v) {
        L.row.push_back(edge->to - patch.own_from);
        L.value.push_back(-edge->weight);
      }
    }
    L.column_first.push_back(static_cast<std::int64_t>(L.row.size()));
  }
  MultifrontalCholesky cholesky{MultifrontalAnalysis(L)};
  cholesky.factor(L);
  cholesky.solve(residual, residual);
  patch.X.bottomRows(patch.own_size()) -= residual;
}

}  // namespace

bool span_least_area(Patch& patch) {
  if (patch.own_size() == 0) {
    return true;
  }
  double area = patch_area(patch);
  for (int step = 1; step <= most_steps; ++step) {
    const double before = area;
    minimise_dirichlet_energy(patch);
    even_out(patch, 1);  // the steps alone would make slivers along a ragged rim
    area = patch_area(patch);
    if (step >= least_steps && before - area <= settled * area) {
      return true;
    }
  }
  return false;
}

}  // namespace ibmfair
