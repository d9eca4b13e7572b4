#include "ibmfair/shapes/loop_subdivision.h"

#include <cmath>
#include <numbers>

#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {
namespace {

/// The weight of each of n neighbours at an inner vertex.
double neighbour_weight(double n) {
  const double c = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4;
  return (5.0 / 8 - c * c) / n;
}

bool on_boundary(const Topology& topology, Index edge) {
  return topology.edge_triangles[edge].size() == 1;
}

Points moved_vertices(const Points& X, const Topology& topology) {
  Points sum = Points::Zero(X.rows(), 3), border_sum = Points::Zero(X.rows(), 3);
  PerVertex count = PerVertex::Zero(X.rows());
  for (Index e = 0; e < topology.E.rows(); ++e) {
    for (const int side : {0, 1}) {
      const Index v = topology.E(e, side), w = topology.E(e, 1 - side);
      sum.row(v) += X.row(w);
      count[v] += 1;
      if (on_boundary(topology, e)) {
        border_sum.row(v) += X.row(w);
      }
    }
  }
  Points Y(X.rows(), 3);
  for (Index v = 0; v < X.rows(); ++v) {
    if (topology.kind[v] == VertexKind::interior) {
      const double weight = neighbour_weight(count[v]);
      Y.row(v) = (1 - count[v] * weight) * X.row(v) + weight * sum.row(v);
    } else {
      Y.row(v) = 0.75 * X.row(v) + 0.125 * border_sum.row(v);
    }
  }
  return Y;
}

Points edge_vertices(const Points& X, const Topology& topology) {
  Points Y(topology.E.rows(), 3);
  for (Index e = 0; e < topology.E.rows(); ++e) {
    const Index a = topology.E(e, 0), b = topology.E(e, 1);
    if (on_boundary(topology, e)) {
      Y.row(e) = (X.row(a) + X.row(b)) / 2;
      continue;
    }
    Y.row(e) = 3 * (X.row(a) + X.row(b)) / 8;
    for (const Index t : topology.edge_triangles[e]) {
      Y.row(e) += X.row(opposite_vertex(topology.F, t, a, b)) / 8;
    }
  }
  return Y;
}

}  // namespace

TriangleMesh loop_subdivide(const TriangleMesh& mesh) {
  const auto old_count = static_cast<Index>(mesh.X.rows());
  const Topology topology = build_topology(old_count, mesh.F);
  // The edge opposite to each corner.
  Triangles across(mesh.F.rows(), 3);
  for (Index e = 0; e < topology.E.rows(); ++e) {
    for (const Index t : topology.edge_triangles[e]) {
      const Index apex = opposite_vertex(mesh.F, t, topology.E(e, 0), topology.E(e, 1));
      across(t, place_of(mesh.F, t, apex)) = old_count + e;
    }
  }
  TriangleMesh fine;
  fine.X.resize(old_count + topology.E.rows(), 3);
  fine.X << moved_vertices(mesh.X, topology), edge_vertices(mesh.X, topology);
  fine.F.resize(4 * mesh.F.rows(), 3);
  for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
    const auto x = mesh.F.row(t);
    const auto m = across.row(t);
    fine.F.row(4 * t) << x[0], m[2], m[1];
    fine.F.row(4 * t + 1) << x[1], m[0], m[2];
    fine.F.row(4 * t + 2) << x[2], m[1], m[0];
    fine.F.row(4 * t + 3) << m[0], m[1], m[2];
  }
  return fine;
}

}  // namespace ibmfair
