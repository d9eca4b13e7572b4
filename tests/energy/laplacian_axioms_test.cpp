// The axioms of discrete Laplacians and mass matrices hold, [W07] sections 2.1 and 2.2, and the
// energies are made of these matrices.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "ibmfair/energy/laplacian_matrices.h"
#include "ibmfair/shapes/polyhedra.h"
#include "ibmfair/shapes/shapes.h"
#include "support/family.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The positions of the nodes: vertices, or midpoints of edges ([W07] (5)).
Points positions(const LaplacianMatrices& matrices, const Points& X, const Topology& topology) {
  Points nodes(static_cast<Index>(matrices.nodes.size()), 3);
  for (Index i = 0; i < nodes.rows(); ++i) {
    const Index node = matrices.nodes[i];
    if (matrices.edge_based) {
      nodes.row(i) = (X.row(topology.E(node, 0)) + X.row(topology.E(node, 1))) / 2;
    } else {
      nodes.row(i) = X.row(node);
    }
  }
  return nodes;
}

bool is_inner_edge(const Topology& topology, Index e) {
  const auto at = topology.edge_triangles[e];
  return at.size() == 2 && topology.usable[at[0]] && topology.usable[at[1]];
}

bool is_inner_vertex(const Topology& topology, Index v) {
  bool complete = topology.kind[v] == VertexKind::interior;
  for (const Index t : topology.stars[v]) {
    complete = complete && topology.usable[t];
  }
  return complete;
}

/// The indices of the inner nodes among all nodes.
std::vector<Index> inner_nodes(const LaplacianMatrices& matrices, const Topology& topology) {
  std::vector<Index> inner;
  for (Index i = 0; i < static_cast<Index>(matrices.nodes.size()); ++i) {
    const Index node = matrices.nodes[i];
    if (matrices.edge_based ? is_inner_edge(topology, node) : is_inner_vertex(topology, node)) {
      inner.push_back(i);
    }
  }
  return inner;
}

class FamilyMembers : public testing::TestWithParam<Member> {
 protected:
  /// Calls `check` for small meshes with triangles of many shapes.
  template <class Check>
  void for_meshes(const std::vector<NamedMesh>& meshes, const Check& check) const {
    for (const auto& [name, mesh] : meshes) {
      const State state(mesh);
      if (state.X.rows() <= 200) {  // dense matrices are for small meshes
        SCOPED_TRACE(name);
        const Points X = shaken(state, 0.05);
        check(state.topology, X, GetParam().matrices(X, state.topology));
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Family, FamilyMembers, testing::ValuesIn(family()),
                         [](const auto& tested) { return identifier(tested.param); });

TEST_P(FamilyMembers, L1AndL2PositiveSemiDefiniteWithNothingButConstantsInTheKernel) {
  for_meshes(good_meshes(), [](const Topology& topology, const Points&,
                               const LaplacianMatrices& matrices) {
    const Eigen::MatrixXd L = dense(matrices.L);
    EXPECT_LE((L * Eigen::VectorXd::Ones(L.rows())).cwiseAbs().maxCoeff(),
              1e-13 * L.cwiseAbs().maxCoeff());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(L, Eigen::EigenvaluesOnly);
    const Eigen::VectorXd values = solver.eigenvalues() / solver.eigenvalues().tail(1)[0];
    const Index parts = topology.component_count;
    EXPECT_GE(values[0], -1e-13);
    EXPECT_LE(values[parts - 1], 1e-13);
    EXPECT_GE(values[parts], 1e-4);
    const std::vector<Index> part = joined_parts(matrices);
    EXPECT_EQ(*std::max_element(part.begin(), part.end()) + 1, parts);
  });
}

TEST_P(FamilyMembers, L3UnchangedByScaling) {
  for_meshes(all_meshes(),
             [](const Topology& topology, const Points& X, const LaplacianMatrices& matrices) {
               const Eigen::MatrixXd L = dense(matrices.L);
               for (const double scale : {1e-5, 1e5}) {
                 const Eigen::MatrixXd scaled = dense(GetParam().matrices(scale * X, topology).L);
                 EXPECT_LE((scaled - L).norm(), 1e-12 * L.norm());
               }
             });
}

TEST_P(FamilyMembers, L4ZeroOnLinearFunctionsOverAPlane) {
  const Mesh sheet = flat_sheet(8, 5);
  Points X = shaken(State(sheet), 0.2);
  X.col(2).setZero();
  const State tilted(moved({X, sheet.faces}, 1.0, Vec3(1, 2, 3)));
  const LaplacianMatrices matrices = GetParam().matrices(tilted.X, tilted.topology);
  const std::vector<Index> inner = inner_nodes(matrices, tilted.topology);
  ASSERT_FALSE(inner.empty());
  const Points h = dense(matrices.L) * positions(matrices, tilted.X, tilted.topology);
  const double largest = h(inner, Eigen::all).rowwise().norm().maxCoeff();
  if (GetParam().is_flat_on_planes()) {
    EXPECT_LE(largest, 1e-13);
  } else {  // "these Laplacians usually fail to satisfy the geometric condition", [W07] section 2.2
    EXPECT_GE(largest, 0.01);
  }
}

// [W07] calls L intrinsic if L is the same for every isometric embedding of the mesh.
TEST_P(FamilyMembers, AreUnchangedByMotionsAndReflections) {
  for_meshes(good_meshes(),
             [](const Topology& topology, const Points& X, const LaplacianMatrices& matrices) {
               const Eigen::MatrixXd L = dense(matrices.L), M = dense(matrices.M);
               Points other = moved({X, {}}, 1.0, Vec3(0.3, -0.2, 0.5)).X;
               other.col(1) *= -1;
               const LaplacianMatrices moved_matrices = GetParam().matrices(other, topology);
               EXPECT_LE((dense(moved_matrices.L) - L).norm(), 1e-11 * L.norm());
               EXPECT_LE((dense(moved_matrices.M) - M).norm(), 1e-12 * M.norm());
             });
}

TEST_P(FamilyMembers, M1AndM2PositiveDefiniteAndScalingWithArea) {
  for_meshes(all_meshes(), [](const Topology& topology, const Points& X,
                              const LaplacianMatrices& matrices) {
    const Eigen::MatrixXd M = dense(matrices.M);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, Eigen::EigenvaluesOnly);
    EXPECT_GT(solver.eigenvalues()[0], 0);
    for (const double scale : {1e-5, 1e5}) {
      const double factor =
          GetParam().measures_area() ? scale * scale : 1;  // the identity is no mass
      const Eigen::MatrixXd scaled = dense(GetParam().matrices(scale * X, topology).M);
      EXPECT_LE((scaled - factor * M).norm(), 1e-12 * factor * M.norm());
    }
  });
}

TEST_P(FamilyMembers, M3SumsToTheAreaOfARegion) {
  if (!GetParam().measures_area()) {
    GTEST_SKIP() << "the identity is no mass matrix";
  }
  const double cap = std::numbers::pi;  // of the unit sphere above z = 1/2
  const double rim = std::numbers::pi * std::sqrt(3.0);
  for (const int level : {1, 3, 5}) {
    const TriangleMesh ball = make_icosphere({level});
    const Topology topology = build_topology(ball.X, ball.F);
    const LaplacianMatrices matrices = GetParam().matrices(ball.X, topology);
    const Points nodes = positions(matrices, ball.X, topology);
    Eigen::VectorXd region(nodes.rows());
    for (Index i = 0; i < nodes.rows(); ++i) {
      region[i] = nodes(i, 2) > 0.5 ? 1 : 0;
    }
    Points indicator = Points::Zero(nodes.rows(), 3);
    indicator.col(0) = region;
    const double error = std::abs(region.dot(multiply(matrices.M, indicator).col(0)) - cap);
    EXPECT_LT(error, 0.5 * rim * mean_edge_length(ball.X, topology.E)) << level;
  }
}

// [W07] section 2.3: E_b = 1/2 tr(X^T L^T M^-1 L X), over the inner nodes.
TEST_P(FamilyMembers, MakeTheEnergy) {
  for_meshes(all_meshes(), [](const Topology& topology, const Points& X,
                              const LaplacianMatrices& matrices) {
    const std::vector<Index> inner = inner_nodes(matrices, topology);
    const double E = GetParam().energy(X, topology);
    if (inner.empty()) {
      EXPECT_EQ(E, 0);
      return;
    }
    const Points h = dense(matrices.L)(inner, Eigen::all) * positions(matrices, X, topology);
    const Eigen::MatrixXd M = dense(matrices.M)(inner, inner);
    const Points y = M.llt().solve(h);
    EXPECT_NEAR(E, h.cwiseProduct(y).sum() / 2, 1e-11 * E);
  });
}

TEST(Valence, CountsTheTrianglesAroundAVertex) {
  const Member umbrella{"umbrella", "valence"};
  const State torus(make_shape("torus", {.rows = 8}));  // six triangles around each vertex
  EXPECT_EQ(umbrella.energy(torus.X, torus.topology),
            (Member{"umbrella", "none"}.energy(torus.X, torus.topology)));
  const State icosahedron(make_shape("icosahedron"));
  const Eigen::MatrixXd M = dense(umbrella.matrices(icosahedron.X, icosahedron.topology).M);
  EXPECT_LT((M - Eigen::MatrixXd::Identity(12, 12) * 5 / 6).norm(), 1e-15);
}

}  // namespace
}  // namespace ibmfair::test
