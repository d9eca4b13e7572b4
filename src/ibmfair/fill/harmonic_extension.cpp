#include "ibmfair/fill/harmonic_extension.h"

#include <algorithm>
#include <utility>

#include "ibmfair/energy/hessian.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair {
namespace {

/// The pairs (own vertex of the patch, neighbour), sorted.
std::vector<std::pair<Index, Index>> edges_at_own(const Patch& patch) {
  std::vector<std::pair<Index, Index>> edges;
  for (Index t = 0; t < patch.net.size(); ++t) {
    const auto& x = patch.net[t];
    for (int i = 0; i < 3; ++i) {
      for (const int j : {1, 2}) {
        if (x[i] >= patch.own_from) {
          edges.emplace_back(x[i], x[(i + j) % 3]);
        }
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The graph Laplacian (degree matrix minus adjacency matrix) restricted to the patch's own
/// vertices: symmetric positive definite.
SymmetricMatrix graph_laplacian(const Patch& patch,
                                const std::vector<std::pair<Index, Index>>& edges) {
  SymmetricMatrix L;
  auto edge = edges.begin();
  for (Index v = patch.own_from; v < patch.size(); ++v) {
    const std::size_t diagonal = L.row.size();
    L.row.push_back(v - patch.own_from);
    L.value.push_back(0);
    for (; edge != edges.end() && edge->first == v; ++edge) {
      L.value[diagonal] += 1;
      if (edge->second > v) {
        L.row.push_back(edge->second - patch.own_from);
        L.value.push_back(-1);
      }
    }
    L.column_first.push_back(static_cast<std::int64_t>(L.row.size()));
  }
  return L;
}

}  // namespace

std::vector<Index> rim_vertices(const Patch& patch) {
  std::vector<Index> vertices;
  for (const RimEdge& edge : patch.rim) {
    vertices.push_back(patch.mesh_vertex[edge.a]);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Eigen::MatrixXd extend_harmonically(const Patch& patch, const Eigen::MatrixXd& at_rim) {
  if (patch.own_size() == 0) {
    return {0, at_rim.cols()};
  }
  const std::vector<Index> rim = rim_vertices(patch);
  const auto edges = edges_at_own(patch);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(patch.own_size(), at_rim.cols());
  for (const auto& [v, neighbour] : edges) {
    if (neighbour < patch.own_from) {
      const auto place = std::lower_bound(rim.begin(), rim.end(), patch.mesh_vertex[neighbour]);
      B.row(v - patch.own_from) += at_rim.row(place - rim.begin());
    }
  }
  const SymmetricMatrix L = graph_laplacian(patch, edges);
  MultifrontalCholesky cholesky{MultifrontalAnalysis(L)};
  cholesky.factor(L);
  for (Eigen::Index first = 0; first < B.cols(); first += 3) {  // three columns at a time
    const Eigen::Index count = std::min<Eigen::Index>(3, B.cols() - first);
    Points three = Points::Zero(B.rows(), 3);
    three.leftCols(count) = B.middleCols(first, count);
    cholesky.solve(three, three);
    B.middleCols(first, count) = three.leftCols(count);
  }
  return B;
}

}  // namespace ibmfair
