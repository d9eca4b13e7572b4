// The laws of every bending energy of the family: exact gradients, invariance, and the properties
// that [W07] proves.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/energy/intrinsic_delaunay.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/mesh/geometry.h"
#include "support/family.h"
#include "support/gradient_law.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

class BendingEnergies : public testing::TestWithParam<Member> {};

INSTANTIATE_TEST_SUITE_P(Family, BendingEnergies, testing::ValuesIn(family()),
                         [](const auto& tested) { return identifier(tested.param); });

/// Whether no edge of the intrinsic Delaunay triangulation flips between the two states, and no
/// angle of the mesh passes a right angle, where mixed Voronoi areas change their formula. Energies
/// that use this triangulation or these areas have kinks at such changes.
bool within_one_piece(const Topology& topology, const Points& X, const Points& Y) {
  IntrinsicDelaunay here(topology), there(topology);
  here.triangulate(X);
  there.triangulate(Y);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    const auto x = topology.F.row(t);
    const auto before = triangle_shape(X.row(x[0]), X.row(x[1]), X.row(x[2]));
    const auto after = triangle_shape(Y.row(x[0]), Y.row(x[1]), Y.row(x[2]));
    for (int i = 0; i < 3; ++i) {
      if ((before.cot[i] < 0) != (after.cot[i] < 0)) {
        return false;
      }
    }
  }
  return here.corners() == there.corners();
}

TEST_P(BendingEnergies, GradientAgreesWithCentralDifferencesAtSecondOrder) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    const auto energy = GetParam().create(state.topology);
    const Points X = shaken(state, 0.05);
    if (energy->stencils().size() == 0) {
      Points G;
      EXPECT_EQ(energy->energy_and_gradient(X, G), energy->energy(X)) << name;
      EXPECT_EQ(G.norm(), 0) << name;
      continue;
    }
    const double edge = mean_edge_length(X, state.topology.E);
    const Points reach = edge * random_directions(X.rows(), 3);
    double step = 2e-3;
    while ((GetParam().laplacian == "intrinsic-delaunay" || GetParam().mass == "voronoi") &&
           !within_one_piece(state.topology, X + step * reach, X - step * reach)) {
      step /= 2;
    }
    expect_exact_gradient(*energy, X, edge, step, 1e-3, name);
  }
}

TEST_P(BendingEnergies, GradientIsOrthogonalToRigidMotionsAndScaling) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const auto energy = GetParam().create(state.topology);
    Points G;
    const double E = energy->energy_and_gradient(shaken(state, 0.05), G);
    const Points X = shaken(state, 0.05);
    const double size = G.norm() * X.norm() + E;
    EXPECT_LE(G.colwise().sum().norm(), 1e-12 * size) << name;
    Vec3 torque = Vec3::Zero();
    for (Eigen::Index v = 0; v < X.rows(); ++v) {
      torque += Vec3(X.row(v)).cross(Vec3(G.row(v)));
    }
    EXPECT_LE(torque.norm(), 1e-12 * size) << name;
    // Euler: a function of degree k has <grad, X> = k E; degree 0 with mass, 2 without.
    const double degree = GetParam().measures_area() ? 0 : 2;
    EXPECT_NEAR(G.cwiseProduct(X).sum(), degree * E, 1e-11 * size) << name;
  }
}

// [W07] Theorem 1, (E1) and (E2).
TEST_P(BendingEnergies, IsInvariantUnderRigidMotionReflectionAndScaling) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = shaken(state, 0.05);
    const double E = GetParam().energy(X, state.topology);
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const Mesh other = moved({X, mesh.faces}, scale, scale * Vec3(0.3, -0.2, 0.5));
      const double expected = GetParam().measures_area() ? E : scale * scale * E;
      EXPECT_NEAR(GetParam().energy(other.X, state.topology), expected, 1e-9 * expected + 1e-24)
          << name << " scaled by " << scale;
    }
    Points mirrored = X;
    mirrored.col(0) *= -1;
    EXPECT_NEAR(GetParam().energy(mirrored, state.topology), E, 1e-12 * E) << name;
  }
}

// A sheet in which every row is turned about the edge that it shares with the row before.
Points folded(const Points& sheet, Index rows, unsigned seed) {
  const Points turns = random_directions(rows, seed);
  Points X = sheet;
  double y = 0, z = 0, angle = 0;
  for (Index row = 0; row < rows; ++row) {
    const Index width = static_cast<Index>(sheet.rows()) / rows;
    if (row > 0) {
      const double depth = sheet(row * width, 1) - sheet((row - 1) * width, 1);
      y += depth * std::cos(angle);
      z += depth * std::sin(angle);
    }
    angle += turns(row, 0);
    X.middleRows(row * width, width).rightCols(2).rowwise() = Eigen::RowVector2d(y, z);
  }
  return X;
}

// [W07] Theorem 1, (E3): one matrix gives the energy of all isometric embeddings of the mesh.
TEST_P(BendingEnergies, IsQuadraticUnderIsometricDeformations) {
  if (!GetParam().has_own_hessian()) {
    GTEST_SKIP() << "its matrix is dense, or another one than the Jacobian's";
  }
  constexpr Index rows = 9;
  Mesh sheet = flat_sheet(6, rows - 1);
  for (double& x : sheet.X.col(0)) {
    x += 0.1 * x * x;  // no two columns are alike
  }
  const State flat(sheet);
  const auto energy = GetParam().create(flat.topology);
  const StencilTerms terms(energy->stencils(), flat.topology.vertex_count);
  const HessianAssembler assembler(terms, Unknowns(std::vector<std::uint8_t>(flat.X.rows(), 0)));
  SymmetricMatrix S = assembler.pattern();
  StencilWeights weights;
  energy->linearise(flat.X, weights);
  assembler.assemble(weights, S);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Points X = folded(flat.X, rows, seed);
    const double E = X.cwiseProduct(multiply(S, X)).sum() / 2;
    EXPECT_GT(E, 1e-3);
    EXPECT_NEAR(energy->energy(X), E, 1e-10 * E);
  }
}

Points crumpled_in_its_plane() {
  Points X = shaken(State(flat_sheet(8, 5)), 0.2);  // irregular triangles, still flat
  X.col(2).setZero();
  return X;
}

// (E4)
TEST_P(BendingEnergies, VanishesOnAPlaneIfTheLaplacianDoes) {
  const State tilted(moved({crumpled_in_its_plane(), flat_sheet(8, 5).faces}, 1.0, Vec3(1, 2, 3)));
  const double E = GetParam().energy(tilted.X, tilted.topology);
  if (GetParam().is_flat_on_planes()) {
    EXPECT_LT(E, 1e-24);
  } else {
    EXPECT_GT(E, 1e-3);
  }
}

TEST_P(BendingEnergies, DoesNotDependOnOrientation) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(in_triangles(mesh)), mixed(with_mixed_orientation(in_triangles(mesh)));
    const double E = GetParam().create(state.topology)->energy(state.X);
    EXPECT_NEAR(GetParam().create(mixed.topology)->energy(mixed.X), E, 1e-12 * E + 1e-26) << name;
  }
}

TEST_P(BendingEnergies, LargestTurnIsThatOfTheSharpestHinge) {
  for (const auto& [name, mesh] : all_meshes()) {
    for (const Mesh& turned : {in_triangles(mesh), with_mixed_orientation(in_triangles(mesh))}) {
      const State state(turned);
      const auto energy = GetParam().create(state.topology);
      const double untold = energy->max_dihedral_turn();
      for (const double amount : {0.05, 0.5}) {
        const Points X = shaken(state, amount);
        const Eigen::VectorXd theta = dihedral_angles(X, state.topology.H);
        const double sharpest = theta.size() > 0 ? 1 + std::cos(theta.minCoeff()) : 0;
        const double expected = std::isfinite(untold) ? sharpest : untold;
        Points G;
        energy->energy(X);
        EXPECT_DOUBLE_EQ(energy->max_dihedral_turn() + 1, expected + 1) << name;
        energy->energy_and_gradient(state.X, G);
        energy->energy_and_gradient(X, G);
        EXPECT_DOUBLE_EQ(energy->max_dihedral_turn() + 1, expected + 1) << name;
      }
    }
  }
}

TEST(CrouzeixRaviart, TellsOfTurns) {
  const State state(flat_sheet(3, 3));
  EXPECT_EQ(bending_model("crouzeix-raviart").create(state.topology, {})->max_dihedral_turn(), 0);
}

TEST_P(BendingEnergies, ActiveStencilsHaveTheWholeGradientAtActiveVertices) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = shaken(state, 0.05);
    std::vector<std::uint8_t> active(state.topology.vertex_count, 0);
    for (std::size_t v = 0; v < active.size(); v += 3) {
      active[v] = 1;
    }
    Points whole, part;
    GetParam().create(state.topology)->energy_and_gradient(X, whole);
    bending_model(GetParam().laplacian)
        .create(state.topology, {true, active, GetParam().mass})
        ->energy_and_gradient(X, part);
    for (std::size_t v = 0; v < active.size(); v += 3) {
      EXPECT_LT((whole.row(v) - part.row(v)).norm(), 1e-12 * whole.norm() + 1e-300) << name;
    }
  }
}

TEST_P(BendingEnergies, DefectsLeaveItFinite) {
  for (const auto& [name, mesh] : defective_meshes()) {
    const State state(mesh);
    Points G;
    EXPECT_TRUE(std::isfinite(GetParam().create(state.topology)->energy_and_gradient(state.X, G)))
        << name;
    EXPECT_TRUE(G.allFinite()) << name;
  }
}

// E_DS = sum |e| / h (pi - theta)^2 with 2 A = 3 h |e|: [W07] section 2.4.
double discrete_shells_energy(const Points& X, const Topology& topology) {
  const Eigen::VectorXd theta = dihedral_angles(X, topology.H);
  double E = 0;
  for (Index i = 0; i < topology.H.rows(); ++i) {
    const Vec3 x0 = X.row(topology.H(i, 0)), x1 = X.row(topology.H(i, 1));
    const Vec3 x2 = X.row(topology.H(i, 2)), x3 = X.row(topology.H(i, 3));
    const double A =
        (double_area_vector(x0, x1, x2).norm() + double_area_vector(x1, x0, x3).norm()) / 2;
    const double height = 2 * A / (3 * (x1 - x0).norm());
    E += (x1 - x0).norm() / height * std::pow(std::numbers::pi - theta[i], 2);
  }
  return E;
}

TEST(CrouzeixRaviart, AgreesWithDiscreteShellsToSecondOrder) {  // [W07] Theorem 2
  const State sheet(flat_sheet(6, 6));
  const Points bumps = random_directions(sheet.X.rows(), 5);
  const auto difference = [&](double height) {
    Points X = sheet.X;
    X.col(2) = height * bumps.col(2);
    const double shells = discrete_shells_energy(X, sheet.topology);
    return std::abs(bending_energy(X, sheet.topology, "crouzeix-raviart") - shells) / shells;
  };
  // Both energies are of second order in the height; their difference is of fourth order.
  EXPECT_LT(difference(1e-2), 0.1);
  EXPECT_NEAR(difference(1e-2) / difference(5e-3), 4, 0.2);
  EXPECT_NEAR(difference(5e-3) / difference(2.5e-3), 4, 0.1);
}

TEST(BendingModels, AMassThatDoesNotGoWithTheLaplacianIsRefusedWithThoseThatDo) {
  const State state(flat_sheet(2, 2));
  for (const BendingModel& model : bending_models()) {
    for (const MassMatrix& mass : mass_matrices()) {
      const EnergyOptions options{true, {}, std::string(mass.name)};
      if (std::find(model.masses.begin(), model.masses.end(), mass.name) != model.masses.end()) {
        EXPECT_EQ(mass_matrix(model, options).name, mass.name);
        continue;
      }
      try {
        model.create(state.topology, options);
        FAIL() << model.name << ", " << mass.name;
      } catch (const BadOption& error) {
        EXPECT_NE(std::string(error.what()).find(model.masses.front()), std::string::npos);
      }
    }
  }
}

TEST(BendingModels, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    bending_model("cotan");
    FAIL();
  } catch (const BadOption& error) {
    EXPECT_NE(std::string(error.what()).find("lagrange"), std::string::npos);
  }
}

}  // namespace
}  // namespace ibmfair::test
