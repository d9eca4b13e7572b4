// The terms that a bending energy may have in addition to the plain energy: bounded hinges and
// spontaneous curvature.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/gradient_law.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(SharpHinges, HaveTheExactGradient) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = shaken(state, 0.05);
    for (const double angle : {10.0, 40.0, 120.0}) {
      const auto energy =
          bending_model("crouzeix-raviart").create(state.topology, {.sharp_angle = angle * degree});
      if (energy->stencils().size() > 0) {
        expect_exact_gradient(*energy, X, mean_edge_length(X, state.topology.E), 2e-3, 3e-3, name);
      }
    }
  }
}

TEST(SharpHinges, HaveNoMoreEnergyThanTheBoundAndAreGentleOnesBelowIt) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const double whole = bending_energy(state.X, state.topology, "crouzeix-raviart");
    double last = 0;
    for (const double angle : {1.0, 10.0, 60.0, 179.0}) {
      const double E = bending_model("crouzeix-raviart")
                           .create(state.topology, {.sharp_angle = angle * degree})
                           ->energy(state.X);
      const double bound = 2 * std::sqrt(3.0) * (1 - std::cos(angle * degree));
      EXPECT_LE(E, whole * (1 + 1e-14)) << name;
      EXPECT_LE(E, bound * static_cast<double>(state.topology.H.rows())) << name;
      EXPECT_GE(E, last) << name;
      last = E;
    }
  }
  // On a fine sphere no hinge comes near the bound.
  const State fine(make_shape("icosphere", {.subdivide = 4}));
  const double plain = bending_energy(fine.X, fine.topology, "crouzeix-raviart");
  const auto energy =
      bending_model("crouzeix-raviart").create(fine.topology, {.sharp_angle = 60 * degree});
  EXPECT_NEAR(energy->energy(fine.X), plain, 0.01 * plain);
}

TEST(SharpHinges, LeaveTheHessianPositiveAndPullLessOnIt) {
  const State cube(make_shape("cube", {.subdivide = 3}));
  const auto plain = bending_model("crouzeix-raviart").create(cube.topology, {});
  const auto sharp =
      bending_model("crouzeix-raviart").create(cube.topology, {.sharp_angle = 30 * degree});
  StencilWeights all, bounded;
  plain->linearise(cube.X, all);
  sharp->linearise(cube.X, bounded);
  int gentle = 0, fixed = 0;
  for (Eigen::Index h = 0; h < all.w.size(); ++h) {
    EXPECT_GT(bounded.w[h], 0);
    gentle += bounded.w[h] > 0.999 * all.w[h] ? 1 : 0;
    fixed += bounded.w[h] < 0.02 * all.w[h] ? 1 : 0;  // right angles
  }
  EXPECT_EQ(gentle + fixed, static_cast<int>(all.w.size()));
  EXPECT_EQ(fixed, 12 * 8);
}

TEST(SharpHinges, AreNotForEveryMember) {
  const State state(closed_meshes().front().mesh);
  EXPECT_THROW(bending_model("lagrange").create(state.topology, {.sharp_angle = 1}), BadOption);
  EXPECT_THROW(
      bending_model("crouzeix-raviart").create(state.topology, {.mass = false, .sharp_angle = 1}),
      BadOption);
}

EnergyOptions spontaneous(const State& state, double H0) {
  return {.spontaneous_curvature = Eigen::VectorXd::Constant(state.X.rows(), H0)};
}

TEST(SpontaneousCurvature, HasTheExactGradient) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = shaken(state, 0.05);
    const double edge = mean_edge_length(X, state.topology.E);
    EnergyOptions options = spontaneous(state, 0.7 / edge);
    for (Index v = 0; v < X.rows(); ++v) {
      options.spontaneous_curvature[v] *= 1 + 0.1 * (v % 7);
    }
    const auto energy = bending_model("lagrange").create(state.topology, options);
    if (energy->stencils().size() > 0) {
      expect_exact_gradient(*energy, X, edge, 2e-3, 3e-3, name);
    }
  }
}

TEST(SpontaneousCurvature, OfZeroIsThePlainEnergy) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    EXPECT_EQ(
        bending_model("lagrange").create(state.topology, spontaneous(state, 0))->energy(state.X),
        bending_energy(state.X, state.topology))
        << name;
  }
}

/// The energy of a unit sphere with this spontaneous curvature, and the gradient of the energy
/// along the outward normal, per area.
std::pair<double, double> unit_sphere(int subdivide, double H0) {
  const State state(make_shape("icosphere", {.subdivide = subdivide}));
  Points G;
  const double E = bending_model("lagrange")
                       .create(state.topology, spontaneous(state, H0))
                       ->energy_and_gradient(state.X, G);
  const PerVertex m = lumped_vertex_mass(state.X, state.topology);
  double outward = 0;
  for (Index v = 0; v < state.X.rows(); ++v) {
    outward += G.row(v).dot(state.X.row(v));
  }
  return {E, outward / m.sum()};
}

TEST(SpontaneousCurvature, OfASphereIsTwoOverItsRadius) {
  // The energy is 1/2 (2 - H0)^2 4 pi. Its derivative by the radius at 1 is -4 pi H0 (2 - H0),
  // because E(r) = 2 pi (2 - H0 r)^2.
  for (const double H0 : {2.0, 1.0, -1.0, 3.0}) {
    double last = 0;
    for (const int subdivide : {3, 4, 5}) {
      const auto [E, outward] = unit_sphere(subdivide, H0);
      const double error =
          std::abs(E - 2 * std::numbers::pi * std::pow(2 - H0, 2)) +
          std::abs(4 * std::numbers::pi * outward + 4 * std::numbers::pi * H0 * (2 - H0));
      if (subdivide > 3) {
        EXPECT_LT(error, last / 3.5) << H0;  // second order
      }
      last = error;
    }
    EXPECT_LT(last, 0.05) << H0;
  }
}

TEST(SpontaneousCurvature, ChangesItsSignWithTheOrientation) {
  for (const auto& [name, mesh] : closed_meshes()) {
    Mesh inside_out = in_triangles(mesh);
    const State state(inside_out);
    Triangles F = triangulate(inside_out).F;
    F.col(1).swap(F.col(2));
    const State turned(mesh_from_triangles(mesh.X, F));
    const double E =
        bending_model("lagrange").create(state.topology, spontaneous(state, 0.5))->energy(state.X);
    EXPECT_NEAR(bending_model("lagrange")
                    .create(turned.topology, spontaneous(turned, -0.5))
                    ->energy(state.X),
                E, 1e-12 * E)
        << name;
  }
}

TEST(SpontaneousCurvature, NeedsTwoSidesAndAMemberThatKnowsIt) {
  for (const auto& [name, mesh] : nonorientable_meshes()) {
    const State state(mesh);
    EXPECT_THROW(bending_model("lagrange").create(state.topology, spontaneous(state, 1)), BadMesh)
        << name;
  }
  const State state(closed_meshes().front().mesh);
  EXPECT_THROW(bending_model("crouzeix-raviart").create(state.topology, spontaneous(state, 1)),
               BadOption);
}

}  // namespace
}  // namespace ibmfair::test
