// Laws of the fields on surfaces that users look at.
#include "ibmfair/measure/surface_fields.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/measure/displacement.h"
#include "ibmfair/measure/energy_density.h"
#include "ibmfair/measure/mean_curvature.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/polyhedra.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair {
namespace {

using test::State;

/// The largest distance of the finite values to `expected`; infinite if no value is finite.
double largest_error(const PerVertex& values, double expected) {
  double error = -1;
  for (const double value : values) {
    error = std::isfinite(value) ? std::max(error, std::abs(value - expected)) : error;
  }
  return error < 0 ? std::numeric_limits<double>::infinity() : error;
}

/// Checks that the entries of a and b are both NaN, or differ by at most `tolerance`.
void expect_alike(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    ASSERT_EQ(std::isnan(a[i]), std::isnan(b[i])) << i;
    if (!std::isnan(a[i])) {
      ASSERT_NEAR(a[i], b[i], tolerance) << i;
    }
  }
}

double largest_magnitude(const Eigen::VectorXd& values) {
  return largest_error(values, 0);
}

TEST(MeanCurvature, OfSphereCylinderAndPlane) {
  double coarser = 1;
  for (const int levels : {3, 4, 5}) {
    Mesh sphere = make_shape("icosphere", {.subdivide = levels});
    sphere.X *= 5;
    const State state(sphere);
    const double error = largest_error(mean_curvature(state.X, state.topology), 2.0 / 5);
    EXPECT_LT(error, 0.6 * coarser);  // first order, at the worst vertex
    coarser = error;
  }
  EXPECT_LT(coarser, 1e-3);
  const State cylinder(make_shape("cylinder", {.columns = 256}));
  EXPECT_LT(largest_error(mean_curvature(cylinder.X, cylinder.topology), 1), 1e-3);
  const State plane(make_shape("plane", {.rows = 20}));
  EXPECT_LT(largest_error(mean_curvature(plane.X, plane.topology), 0), 1e-10);
}

TEST(MeanCurvature, TurnsItsSignWithTheOrientation) {
  for (const auto& [name, mesh] : test::closed_meshes()) {
    SCOPED_TRACE(name);
    const State state(mesh);
    Triangles turned = state.topology.F;
    turned.col(0).swap(turned.col(1));
    const PerVertex H = mean_curvature(state.X, state.topology);
    expect_alike(mean_curvature(state.X, build_topology(state.X, turned)), -H,
                 1e-12 * largest_magnitude(H));
  }
}

TEST(MeanCurvature, IsKnownExactlyWhereARingIsComplete) {
  for (const auto& [name, mesh] : test::all_meshes()) {
    SCOPED_TRACE(name);
    const State state(mesh);
    const PerVertex H = mean_curvature(state.X, state.topology);
    for (Index v = 0; v < state.topology.vertex_count; ++v) {
      bool complete = state.topology.kind[v] == VertexKind::interior;
      for (const Index t : state.topology.stars[v]) {
        complete = complete && state.topology.usable[t] != 0;
      }
      EXPECT_EQ(std::isfinite(H[v]), complete) << v;
    }
  }
}

TEST(SurfaceFields, MoveAndScaleWithTheMesh) {
  for (const auto& [name, polygons] : test::good_meshes()) {
    const Mesh mesh = test::in_triangles(polygons);
    const State state(mesh);
    const Points before = test::shaken(state, 0.1);
    for (const double scale : {1e-8, 1.0, 1e8}) {
      const Vec3 offset = scale * Vec3(3, -1, 2);
      const State after(test::moved(mesh, scale, offset));
      const Points after_before =
          test::moved(mesh_from_triangles(before, state.topology.F), scale, offset).X;
      for (const SurfaceField& field : surface_fields()) {
        SCOPED_TRACE(name + " " + std::string(field.name));
        const Eigen::VectorXd expected = field.values({state.X, state.topology, &before});
        const Eigen::VectorXd got = field.values({after.X, after.topology, &after_before});
        EXPECT_EQ(expected.size(), field.place == SurfaceField::Place::vertex
                                       ? state.topology.vertex_count
                                       : state.topology.F.rows());
        expect_alike(got / std::pow(scale, field.dimension), expected,
                     1e-7 * std::max(1.0, largest_magnitude(expected)));
      }
    }
  }
}

TEST(EnergyDensity, SumsUpToTheEnergy) {
  for (const auto& [name, mesh] : test::all_meshes()) {
    const State state(mesh);
    for (const BendingModel& model : bending_models()) {
      SCOPED_TRACE(name + " " + std::string(model.name));
      const PerVertex density = energy_density(state.X, state.topology, model.name);
      const PerVertex mass = lumped_vertex_mass(state.X, state.topology);
      double sum = 0;
      for (Eigen::Index v = 0; v < mass.size(); ++v) {
        EXPECT_EQ(std::isfinite(density[v]), mass[v] > 0) << v;
        sum += mass[v] > 0 ? density[v] * mass[v] : 0;
      }
      const double energy = bending_energy(state.X, state.topology, model.name);
      EXPECT_NEAR(sum, energy, 1e-9 * std::max(1.0, energy));
    }
  }
}

TEST(Displacement, IsSignedAlongTheNormalAndNaNForNewVertices) {
  const State state(make_shape("icosphere", {.subdivide = 3}));
  const Points grown = 1.5 * state.X;
  expect_alike(normal_displacement(state.X, grown, state.topology),
               PerVertex::Constant(state.X.rows(), 0.5), 1e-3);
  expect_alike(normal_displacement(grown, state.X, state.topology),
               PerVertex::Constant(state.X.rows(), -0.5), 1e-3);
  expect_alike(displacement_length(grown, state.X), PerVertex::Constant(state.X.rows(), 0.5),
               1e-12);
  const Points fewer = state.X.topRows(100);
  const PerVertex known = displacement_length(fewer, grown);
  EXPECT_EQ(known.size(), grown.rows());
  EXPECT_TRUE(known.head(100).allFinite());
  EXPECT_TRUE(known.tail(known.size() - 100).array().isNaN().all());
}

TEST(TriangleQuality, IsOneForEquilateralOnesAndZeroForNone) {
  Points X(5, 3);
  X << 0, 0, 0, 2, 0, 0, 1, std::sqrt(3), 0, 4, 0, 0, 1, 1e-3, 0;
  Triangles F(4, 3);
  F << 0, 1, 2, 0, 1, 3, 0, 0, 0, 0, 1, 4;
  const Eigen::VectorXd quality = triangle_qualities(X, F);
  EXPECT_NEAR(quality[0], 1, 1e-15);
  EXPECT_EQ(quality[1], 0);
  EXPECT_EQ(quality[2], 0);
  EXPECT_NEAR(quality[3], 4 * std::sqrt(3) * 1e-3 / 6, 1e-8);
}

TEST(RobustRange, LeavesOutWildValuesOfLittleArea) {
  // On a fine sphere, all vertices have about the same area.
  const TriangleMesh sphere = make_icosphere({.levels = 4});
  const State state(mesh_from_triangles(sphere.X, sphere.F));
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(sphere.X.rows(), -1, 3);
  values[500] = 1e30;
  values[501] = std::numeric_limits<double>::quiet_NaN();
  values[502] = std::numeric_limits<double>::infinity();
  const FieldState at{state.X, state.topology};
  const ValueRange plain = robust_range(surface_field("displacement"), values, at);
  EXPECT_NEAR(plain.low, -0.96, 0.03);
  EXPECT_NEAR(plain.high, 2.96, 0.03);
  const ValueRange diverging = robust_range(surface_field("mean_curvature"), values, at);
  EXPECT_EQ(diverging.low, -diverging.high);
  EXPECT_NEAR(diverging.high, 2.96, 0.03);
}

TEST(RobustRange, CountsAreaNotVertices) {
  // Many small triangles at one place have the value 7; there are two large triangles besides.
  const TriangleMesh fine = make_plane(1, {.rows = 24});
  const Eigen::Index n = fine.X.rows(), m = fine.F.rows();
  Points X(n + 4, 3);
  X << 1e-3 * fine.X, Points::Zero(4, 3);
  X.bottomRows(4) << 2, 0, 0, 3, 0, 0, 3, 1, 0, 2, 1, 0;
  Triangles F(m + 2, 3);
  const auto v = static_cast<Index>(n);
  F << fine.F, Triangles::Zero(2, 3);
  F.bottomRows(2) << v, v + 1, v + 2, v, v + 2, v + 3;
  const State state(mesh_from_triangles(X, F));
  Eigen::VectorXd values = Eigen::VectorXd::Constant(n + 4, 7);
  values.tail(4) << 0, 0.5, 1, 0.5;
  const ValueRange range =
      robust_range(surface_field("displacement"), values, {state.X, state.topology});
  EXPECT_LE(range.high, 1);
}

TEST(RobustRange, RoundingIsNotSpreadOverAllColours) {
  const TriangleMesh sphere = make_icosphere({.levels = 2});
  for (const double size : {1e-6, 1.0, 1e6}) {
    const State state(mesh_from_triangles(size * sphere.X, sphere.F));
    const FieldState at{state.X, state.topology};
    const Eigen::VectorXd rounding =
        1e-14 * size * Eigen::VectorXd::LinSpaced(sphere.X.rows(), -1, 1);
    const ValueRange length = robust_range(surface_field("displacement"), rounding, at);
    EXPECT_GT(length.high - length.low, 1e-7 * size);
    const ValueRange curvature =
        robust_range(surface_field("mean_curvature"), rounding / (size * size), at);
    EXPECT_GT(curvature.high, 1e-7 / size);
    EXPECT_EQ(curvature.low, -curvature.high);
    const ValueRange none = robust_range(surface_field("mean_curvature"), Eigen::VectorXd(), at);
    EXPECT_GT(none.high, none.low);
  }
}

}  // namespace
}  // namespace ibmfair
