// The intrinsic Delaunay triangulation has no negative weights, and keeps the metric of the mesh.
#include "ibmfair/energy/intrinsic_delaunay.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/energy/laplacian_matrices.h"
#include "ibmfair/shapes/polyhedra.h"
#include "support/family.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

const Member delaunay{"intrinsic-delaunay", "voronoi"};

/// The largest off-diagonal entry of L, apart from the entries of boundary edges. If it is not
/// positive, no inner edge has a negative weight.
double largest_inner_entry(const Topology& topology, const LaplacianMatrices& matrices) {
  double largest = -1;
  const SymmetricMatrix& L = matrices.L;
  for (std::int64_t j = 0; j < L.size(); ++j) {
    for (std::int64_t k = L.column_first[j] + 1; k < L.column_first[j + 1]; ++k) {
      const bool inner = topology.kind[matrices.nodes[j]] == VertexKind::interior ||
                         topology.kind[matrices.nodes[L.row[k]]] == VertexKind::interior;
      largest = inner ? std::max(largest, L.value[k]) : largest;
    }
  }
  return largest;
}

/// The mesh stretched, so that many of its triangles are obtuse.
Points stretched(const State& state) {
  Points X = shaken(state, 0.2);
  X.col(0) *= 4;
  return X;
}

TEST(IntrinsicDelaunay, HasNoNegativeWeights) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    const Points X = stretched(state);
    EXPECT_LE(largest_inner_entry(state.topology, delaunay.matrices(X, state.topology)), 1e-10)
        << name;
  }
  const State ball(closed_meshes()[3].mesh);  // its own triangles have negative weights
  EXPECT_GT(largest_inner_entry(ball.topology, Member{"lagrange", "voronoi"}.matrices(
                                                   stretched(ball), ball.topology)),
            0.1);
}

TEST(IntrinsicDelaunay, LeavesADelaunayMeshAsItIs) {
  for (const Member& member : {Member{"lagrange", "voronoi"}, Member{"lagrange", "none"}}) {
    for (const int level : {0, 2, 3}) {
      const TriangleMesh ball = make_icosphere({level});
      const Topology topology = build_topology(ball.X, ball.F);
      IntrinsicDelaunay triangulation(topology);
      triangulation.triangulate(ball.X);
      EXPECT_EQ(triangulation.flips(), 0);
      EXPECT_EQ(triangulation.corners(), topology.F);
      Points G, H;
      const auto flipped = Member{"intrinsic-delaunay", member.mass}.create(topology);
      const auto own = member.create(topology);
      const double E = own->energy_and_gradient(ball.X, G);
      EXPECT_NEAR(flipped->energy_and_gradient(ball.X, H), E, 1e-13 * E);
      EXPECT_LE((H - G).norm(), 1e-12 * G.norm() + 1e-12 * E);
    }
  }
}

// In a plane, the intrinsic Delaunay triangulation is the Delaunay triangulation, which does not
// depend on the triangulation where the flips began.
TEST(IntrinsicDelaunay, OfAPlaneDoesNotDependOnTheTriangulation) {
  const Mesh sheet = flat_sheet(9, 7);
  Points X = shaken(State(sheet), 0.25);
  X.col(2).setZero();
  Mesh other = sheet;
  other.faces = {};
  for (Index f = 0; f < sheet.faces.size();
       f += 2) {  // two triangles a b c, a c d to a quadrilateral
    const auto abc = sheet.faces[f], acd = sheet.faces[f + 1];
    other.faces.add(std::array{abc[0], abc[1], acd[2]});
    other.faces.add(std::array{abc[1], abc[2], acd[2]});
  }
  const Topology one = State(sheet).topology, two = State(other).topology;
  const auto matrix = [&](const Topology& topology) { return delaunay.matrices(X, topology); };
  const LaplacianMatrices a = matrix(one), b = matrix(two);
  const Points U = random_directions(X.rows(), 7);
  EXPECT_LE((multiply(a.L, U) - multiply(b.L, U)).norm(), 1e-11 * multiply(a.L, U).norm());
}

// Rippa's theorem: of all triangulations, the Delaunay triangulation has the least Dirichlet
// energy.
TEST(IntrinsicDelaunay, HasNoMoreDirichletEnergyThanTheMesh) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = stretched(state), U = random_directions(X.rows(), 5);
    const LaplacianMatrices own = Member{"lagrange", "none"}.matrices(X, state.topology);
    const LaplacianMatrices least = delaunay.matrices(X, state.topology);
    const Points u = U(own.nodes, Eigen::all);
    const double D = u.cwiseProduct(multiply(own.L, u)).sum();
    EXPECT_LE(u.cwiseProduct(multiply(least.L, u)).sum(), D * (1 + 1e-12)) << name;
  }
}

TEST(IntrinsicDelaunay, KeepsTheAreaAndTheMetric) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    const Points X = stretched(state);
    IntrinsicDelaunay triangulation(state.topology);
    triangulation.triangulate(X);
    double area = 0, own_area = 0;
    for (const auto& shape : triangulation.shapes()) {
      area += shape.area;
      // Heron's formula: the stored quantities of a triangle agree with each other.
      EXPECT_NEAR(shape.squared[0], 2 * shape.area * (shape.cot[1] + shape.cot[2]),
                  1e-9 * (shape.squared[0] + shape.squared[1] + shape.squared[2]))
          << name;
    }
    const Eigen::VectorXd areas = triangle_areas(X, state.topology.F);
    for (Index t = 0; t < areas.size(); ++t) {
      own_area += state.topology.usable[t] ? areas[t] : 0;
    }
    EXPECT_NEAR(area, own_area, 1e-12 * own_area) << name;
  }
}

// Derivatives by the lengths of flipped edges are brought back to the edges of the mesh.
TEST(IntrinsicDelaunay, PullsDerivativesBackOverItsFlips) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = stretched(state), D = random_directions(X.rows(), 3);
    const Edges& E = state.topology.E;
    const Points factors = random_directions(E.rows(), 9);
    IntrinsicDelaunay triangulation(state.topology);
    const auto value = [&](const Points& Y) {
      triangulation.triangulate(Y);
      std::vector<double> squared(static_cast<std::size_t>(E.rows()), 0);
      for (Index t = 0; t < triangulation.corners().rows(); ++t) {
        for (int i = 0; i < 3; ++i) {
          squared[triangulation.sides()(t, i)] = triangulation.shapes()[t].squared[i];
        }
      }
      return Eigen::VectorXd::Map(squared.data(), E.rows()).dot(factors.col(0));
    };
    const double h = 1e-7 * mean_edge_length(X, E);
    const double difference = (value(X + h * D) - value(X - h * D)) / (2 * h);
    value(X);
    std::vector<double> by_squared(factors.col(0).begin(), factors.col(0).end());
    triangulation.pull_back(by_squared);
    double exact = 0, size = 0;
    for (Index e = 0; e < E.rows(); ++e) {
      const double slope = 2 * by_squared[e] *
                           (X.row(E(e, 0)) - X.row(E(e, 1))).dot(D.row(E(e, 0)) - D.row(E(e, 1)));
      exact += slope;
      size += std::abs(slope);
    }
    EXPECT_NEAR(difference, exact, 1e-6 * size) << name;
  }
}

}  // namespace
}  // namespace ibmfair::test
