#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/mesh/geometry.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// Every member of the family, with and without mass matrix.
struct Variant {
  std::string name;
  std::string_view model;
  bool mass;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const BendingModel& model : bending_models()) {
    for (const bool mass : {true, false}) {
      all.push_back({std::string(model.name) + (mass ? "" : " without mass"), model.name, mass});
    }
  }
  return all;
}

std::unique_ptr<BendingEnergy> bind(const Variant& variant, const Topology& topology) {
  return bending_model(variant.model).bind(topology, {variant.mass, {}});
}

TEST(BendingEnergy, GradientAgreesWithCentralDifferencesAtSecondOrder) {
  for (const Variant& variant : variants()) {
    for (const auto& [name, mesh] : all_meshes()) {
      const State state(mesh);
      const auto energy = bind(variant, state.topology);
      const Points X = shaken(state, 0.05);
      Points G;
      const double E = energy->energy_and_gradient(X, G);
      EXPECT_NEAR(E, energy->energy(X), 1e-12 * E) << variant.name << ", " << name;
      if (energy->stencils().size() == 0) {
        EXPECT_EQ(G.norm(), 0) << variant.name << ", " << name;
        continue;
      }
      const Points D = random_directions(X.rows(), 3);
      const double exact = G.cwiseProduct(D).sum();
      const double edge = mean_edge_length(X, state.topology.E);
      const auto error = [&](double step) {
        const double h = step * edge;
        return std::abs((energy->energy(X + h * D) - energy->energy(X - h * D)) / (2 * h) - exact);
      };
      const double coarse = error(2e-3), fine = error(1e-3);
      EXPECT_LT(fine, 1e-3 * (std::abs(exact) + E / edge)) << variant.name << ", " << name;
      // Halving the step divides the error by four, down to rounding.
      const double rounding = 1e-11 * E / (1e-3 * edge);
      EXPECT_LT(fine, coarse / 3.5 + rounding) << variant.name << ", " << name;
    }
  }
}

TEST(BendingEnergy, GradientIsOrthogonalToRigidMotionsAndScaling) {
  for (const Variant& variant : variants()) {
    for (const auto& [name, mesh] : good_meshes()) {
      const State state(mesh);
      const auto energy = bind(variant, state.topology);
      Points G;
      const double E = energy->energy_and_gradient(shaken(state, 0.05), G);
      const Points X = shaken(state, 0.05);
      const double size = G.norm() * X.norm() + E;
      EXPECT_LE(G.colwise().sum().norm(), 1e-12 * size) << variant.name << ", " << name;
      Vec3 torque = Vec3::Zero();
      for (Eigen::Index v = 0; v < X.rows(); ++v) {
        torque += Vec3(X.row(v)).cross(Vec3(G.row(v)));
      }
      EXPECT_LE(torque.norm(), 1e-12 * size) << variant.name << ", " << name;
      // Euler: a function of degree k has <grad, X> = k E; degree 0 with mass, 2 without.
      const double degree = variant.mass ? 0 : 2;
      EXPECT_NEAR(G.cwiseProduct(X).sum(), degree * E, 1e-11 * size)
          << variant.name << ", " << name;
    }
  }
}

TEST(BendingEnergy, IsInvariantUnderRigidMotionReflectionAndScaling) {
  for (const BendingModel& model : bending_models()) {
    for (const auto& [name, mesh] : good_meshes()) {
      const State state(mesh);
      const double E = bending_energy(state.X, state.topology, model.name);
      for (const double scale : {1e-6, 1.0, 1e6}) {
        const Mesh other = moved(mesh, scale, scale * Vec3(0.3, -0.2, 0.5));
        EXPECT_NEAR(bending_energy(other.X, state.topology, model.name), E, 1e-9 * E + 1e-24)
            << model.name << ", " << name << " scaled by " << scale;
      }
      Points mirrored = state.X;
      mirrored.col(0) *= -1;
      EXPECT_NEAR(bending_energy(mirrored, state.topology, model.name), E, 1e-12 * E)
          << model.name << ", " << name;
    }
  }
}

TEST(BendingEnergy, ScalesWithTheSquareOfLengthWithoutMass) {
  for (const BendingModel& model : bending_models()) {
    const State state(closed_meshes().back().mesh);
    const auto energy = model.bind(state.topology, {false, {}});
    EXPECT_NEAR(energy->energy(10 * state.X), 100 * energy->energy(state.X),
                1e-9 * energy->energy(10 * state.X))
        << model.name;
  }
}

TEST(BendingEnergy, VanishesOnAPlane) {
  for (const Variant& variant : variants()) {
    Mesh sheet = flat_sheet(8, 5);
    const State straight(sheet);
    Points X = shaken(straight, 0.2);  // irregular triangles, still flat
    X.col(2).setZero();
    sheet.X = X;
    const State tilted(moved(sheet, 1.0, Vec3(1, 2, 3)));
    EXPECT_LT(bind(variant, tilted.topology)->energy(tilted.X), 1e-24) << variant.name;
  }
}

TEST(BendingEnergy, DoesNotDependOnOrientation) {
  for (const Variant& variant : variants()) {
    for (const auto& [name, mesh] : all_meshes()) {
      const State state(in_triangles(mesh)), mixed(with_mixed_orientation(in_triangles(mesh)));
      const double E = bind(variant, state.topology)->energy(state.X);
      EXPECT_NEAR(bind(variant, mixed.topology)->energy(mixed.X), E, 1e-12 * E)
          << variant.name << ", " << name;
    }
  }
}

TEST(BendingEnergy, ActiveStencilsHaveTheWholeGradientAtActiveVertices) {
  for (const Variant& variant : variants()) {
    for (const auto& [name, mesh] : good_meshes()) {
      const State state(mesh);
      const Points X = shaken(state, 0.05);
      std::vector<std::uint8_t> active(state.topology.vertex_count, 0);
      for (std::size_t v = 0; v < active.size(); v += 3) {
        active[v] = 1;
      }
      Points whole, part;
      bind(variant, state.topology)->energy_and_gradient(X, whole);
      bending_model(variant.model)
          .bind(state.topology, {variant.mass, active})
          ->energy_and_gradient(X, part);
      for (std::size_t v = 0; v < active.size(); v += 3) {
        EXPECT_LT((whole.row(v) - part.row(v)).norm(), 1e-12 * whole.norm() + 1e-300)
            << variant.name << ", " << name;
      }
    }
  }
}

TEST(BendingEnergy, DefectsLeaveItFinite) {
  for (const Variant& variant : variants()) {
    for (const auto& [name, mesh] : defective_meshes()) {
      const State state(mesh);
      Points G;
      EXPECT_TRUE(std::isfinite(bind(variant, state.topology)->energy_and_gradient(state.X, G)))
          << variant.name << ", " << name;
      EXPECT_TRUE(G.allFinite()) << variant.name << ", " << name;
    }
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
  // Both are of second order in the height; what they differ by is of fourth.
  EXPECT_LT(difference(1e-2), 0.1);
  EXPECT_NEAR(difference(1e-2) / difference(5e-3), 4, 0.2);
  EXPECT_NEAR(difference(5e-3) / difference(2.5e-3), 4, 0.1);
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
