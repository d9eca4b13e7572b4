// The bending energy with weights along material directions, [W07] (14).
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/gradient_law.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::unique_ptr<BendingEnergy> directed(const State& state, const Points& reference,
                                        const Vec3& direction, double factor,
                                        const std::string& mass = {}) {
  return bending_model("lagrange")
      .create(state.topology, {.mass_matrix = mass,
                               .material_directions = material_directions(reference, state.topology,
                                                                          direction, factor)});
}

TEST(Anisotropy, WithoutAFactorIsTheCotangentLaplacianHoweverTrianglesDeform) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const auto energy = directed(state, state.X, Vec3(1, 2, -1), 1);
    for (const Points& X : {state.X, shaken(state, 0.1)}) {
      const double E = bending_energy(X, state.topology);
      EXPECT_NEAR(energy->energy(X), E, 1e-10 * E + 1e-24) << name;
    }
  }
}

TEST(Anisotropy, HasTheExactGradient) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    for (const char* mass : {"barycentric", "galerkin", "none"}) {
      const auto energy = directed(state, state.X, Vec3(1, 2, -1), 5, mass);
      if (energy->stencils().size() == 0) {
        continue;
      }
      const Points X = shaken(state, 0.05);
      expect_exact_gradient(*energy, X, mean_edge_length(X, state.topology.E), 2e-3, 3e-3,
                            fmt::format("{}, {}", name, mass));
    }
  }
}

TEST(Anisotropy, DoesNotDependOnPositionOrientationAndScale) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    const Points X = shaken(state, 0.05);
    const double E = directed(state, state.X, Vec3::UnitX(), 4)->energy(X);
    // The directions stay with the material when the sheet is rotated, scaled and moved.
    const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()).matrix();
    const Points carried = (3 * X * R.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3);
    EXPECT_NEAR(directed(state, state.X, Vec3::UnitX(), 4)->energy(carried), E, 1e-9 * E) << name;
    const State mixed(with_mixed_orientation(in_triangles(mesh)));
    const State plain(in_triangles(mesh));
    EXPECT_NEAR(directed(mixed, mixed.X, Vec3::UnitX(), 4)->energy(mixed.X),
                directed(plain, plain.X, Vec3::UnitX(), 4)->energy(plain.X), 1e-10 * E)
        << name;
  }
}

/// A unit square is bent without stretching onto a cylinder of curvature 1 about the y axis.
/// Returns its energy with material directions of the flat square, divided by its energy without
/// directions.
double bent_ratio(Index squares, const Vec3& direction, double factor) {
  const State flat(flat_sheet(squares, squares));
  Points X = flat.X;
  X.col(0) = flat.X.col(0).array().sin();
  X.col(2) = flat.X.col(0).array().cos();
  return directed(flat, flat.X, direction, factor)->energy(X) / bending_energy(X, flat.topology);
}

TEST(Anisotropy, OfABentSheetHasTheSquaredFactorOfTheBentDirection) {
  // kappa_1 and kappa_2 are cos^2 and sin^2 of the angle to the bent direction.
  constexpr double factor = 3;
  for (const double angle : {0.0, 0.5, std::numbers::pi / 4, std::numbers::pi / 2}) {
    const Vec3 direction(std::cos(angle), std::sin(angle), 0);
    const double along = std::pow(std::cos(angle), 2), across = std::pow(std::sin(angle), 2);
    const double exact = std::pow(factor * along + across, 2);
    const double coarse = std::abs(bent_ratio(16, direction, factor) - exact);
    const double fine = std::abs(bent_ratio(32, direction, factor) - exact);
    EXPECT_LT(fine, 1e-3 * exact) << angle;
    EXPECT_LT(fine, coarse / 3 + 1e-10) << angle;
  }
}

TEST(Anisotropy, HessianIsThatOfTheEnergyOfASheet) {
  const State sheet(flat_sheet(8, 6));
  const auto energy = directed(sheet, sheet.X, Vec3(1, 0.3, 0), 7);
  StencilWeights weights;
  energy->linearise(sheet.X, weights);
  for (const double w : weights.w) {
    EXPECT_GT(w, 0);  // S = sum_s w_s c_s c_s^T is positive semi-definite
  }
  const Points D = random_directions(sheet.X.rows());
  double exact = 0;
  for (Index s = 0; s < energy->stencils().size(); ++s) {
    const auto star = energy->stencils()[s];
    double curvature = 0;
    for (std::size_t i = 0; i < star.size(); ++i) {
      curvature +=
          weights.c[energy->stencils().first[s] + static_cast<std::int64_t>(i)] * D(star[i], 2);
    }
    exact += weights.w[s] * curvature * curvature / 2;
  }
  constexpr double height = 1e-5;
  Points X = sheet.X;
  X.col(2) += height * D.col(2);
  EXPECT_NEAR(energy->energy(X) / (height * height), exact, 1e-4 * exact);
}

TEST(Anisotropy, SmoothsRipplesAcrossTheDirectionLess) {
  // A sheet with ripples in both directions: the ripples along the direction in which curvature
  // counts more disappear first.
  State sheet(flat_sheet(40, 40));
  for (Index v = 0; v < sheet.X.rows(); ++v) {
    sheet.X(v, 2) = 0.005 * (std::cos(24 * sheet.X(v, 0)) + std::cos(24 * sheet.X(v, 1)));
  }
  FlowOptions options;
  options.laplacian = "lagrange";
  options.relax = false;
  options.material_directions = material_directions(sheet.X, sheet.topology, Vec3::UnitX(), 4);
  const double time = time_for_cutoff(8 * mean_edge_length(sheet.X, sheet.topology.E));
  options.total_time = time_in_flow_units(time, sheet.X, sheet.topology, options);
  Points X = sheet.X;
  const auto report = willmore_flow(
      X, sheet.topology, fixed_vertices(sheet.topology, BoundaryCondition::fixed), options);
  EXPECT_EQ(report.status, FlowStatus::completed);
  const auto amplitude = [](const Points& positions, int axis) {
    double sum = 0;
    for (const auto& x : positions.rowwise()) {
      const bool inside = (x.head<2>().array() - 0.5).abs().maxCoeff() < 0.3;
      sum += inside ? x[2] * std::cos(24 * x[axis]) : 0;
    }
    return sum;
  };
  const double along = amplitude(X, 0) / amplitude(sheet.X, 0);
  const double across = amplitude(X, 1) / amplitude(sheet.X, 1);
  EXPECT_LT(along, 0.5 * across);
}

TEST(Anisotropy, RefusesWhatCannotBe) {
  const State state(closed_meshes().front().mesh);
  EXPECT_THROW(material_directions(state.X, state.topology, Vec3::Zero(), 2), BadOption);
  EXPECT_THROW(material_directions(state.X, state.topology, Vec3::UnitX(), 0), BadOption);
  const auto directions = material_directions(state.X, state.topology, Vec3::UnitX(), 2);
  EXPECT_THROW(
      bending_model("umbrella").create(state.topology, {.material_directions = directions}),
      BadOption);
  EXPECT_THROW(
      bending_model("lagrange")
          .create(state.topology, {.material_directions = directions,
                                   .spontaneous_curvature = Eigen::VectorXd::Ones(state.X.rows())}),
      BadOption);
}

}  // namespace
}  // namespace ibmfair::test
