// The generated shapes have the topology, the area and the volume of their surfaces; the noise is
// normal and reproducible.
#include "ibmfair/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/jitter.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/polyhedra.h"

namespace ibmfair {
namespace {

using std::numbers::pi;

struct Expectation {
  std::string name;
  TriangleMesh mesh;
  int euler_characteristic;
  std::size_t loops;
};

std::vector<Expectation> examples() {
  std::vector<Expectation> all;
  for (const int levels : {0, 1, 3}) {
    const std::string at = " " + std::to_string(levels);
    all.push_back({"icosahedron" + at, make_icosahedron({levels}), 2, 0});
    all.push_back({"refined icosahedron" + at, make_icosahedron({levels, 7}), 2, 0});
    all.push_back({"icosphere" + at, make_icosphere({levels}), 2, 0});
    all.push_back({"refined icosphere" + at, make_icosphere({levels, 19}), 2, 0});
    all.push_back({"cube" + at, make_cube({levels, 0}), 2, 0});
    all.push_back({"cubesphere" + at, make_cubesphere({levels}), 2, 0});
    all.push_back({"hexagon" + at, make_hexagon({levels}), 1, 1});
  }
  for (const bool straight : {false, true}) {
    for (const Index rows : {4, 6, 12}) {
      const std::string at = (straight ? " straight " : " ") + std::to_string(rows);
      all.push_back({"torus" + at, make_torus(1.5, {rows, 9, straight}), 0, 0});
      all.push_back({"cylinder" + at, make_cylinder(2.0, {rows - 1, 9, straight}), 0, 2});
      const Jitter jitter{0.3, 5};
      all.push_back({"jittered torus" + at, make_torus(1.5, {rows, 9, straight, jitter}), 0, 0});
      all.push_back({"catenoid" + at, make_catenoid(2.0, {rows - 1, 9, straight}), 0, 2});
      all.push_back(
          {"jittered catenoid" + at, make_catenoid(2.0, {rows - 1, 9, straight, jitter}), 0, 2});
      all.push_back({"plane" + at, make_plane(0.7, {rows - 1, 5, straight}), 1, 1});
      all.push_back({"plane, even" + at, make_plane(0.7, {rows, 5, straight}), 1, 1});
    }
  }
  return all;
}

TEST(Shapes, AreSurfacesOfTheirTopologyWithCoherentOrientation) {
  for (const auto& [name, mesh, characteristic, loops] : examples()) {
    SCOPED_TRACE(name);
    const Topology topology = build_topology(mesh.X, mesh.F);
    EXPECT_TRUE(topology.defects.empty());
    EXPECT_TRUE(topology.orientable);
    EXPECT_EQ(topology.turned_triangles, 0);
    EXPECT_EQ(topology.component_count, 1);
    EXPECT_EQ(topology.euler_characteristic(), characteristic);
    EXPECT_EQ(topology.boundary_loops.size(), loops);
    EXPECT_EQ(std::count(topology.kind.begin(), topology.kind.end(), VertexKind::isolated), 0);
    if (loops == 0) {
      EXPECT_GT(enclosed_volume(mesh.X, mesh.F), 0.0);
    }
  }
}

TEST(Shapes, FlatOnesHaveTheirExactAreaHoweverTheyAreSplit) {
  const double a = 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));
  for (const Subdivision& split : {Subdivision{0}, Subdivision{2}, Subdivision{2, 3}}) {
    const TriangleMesh icosahedron = make_icosahedron(split);
    const TriangleMesh cube = make_cube(split);
    const TriangleMesh hexagon = make_hexagon(split);
    EXPECT_NEAR(surface_area(icosahedron.X, icosahedron.F), 5.0 * std::sqrt(3.0) * a * a, 1e-12);
    EXPECT_NEAR(enclosed_volume(icosahedron.X, icosahedron.F),
                5.0 / 12.0 * (3.0 + std::sqrt(5.0)) * a * a * a, 1e-12);
    EXPECT_NEAR(surface_area(cube.X, cube.F), 24.0, 1e-12);
    EXPECT_NEAR(enclosed_volume(cube.X, cube.F), 8.0, 1e-12);
    EXPECT_NEAR(surface_area(hexagon.X, hexagon.F), 1.5 * std::sqrt(3.0), 1e-12);
  }
  for (const bool straight : {false, true}) {
    const TriangleMesh plane = make_plane(0.3, {{}, 17, straight});
    EXPECT_NEAR(surface_area(plane.X, plane.F), 0.3, 1e-13);
    for (Index f = 0; f < plane.F.rows(); ++f) {
      EXPECT_GT(double_area_vector(plane.X.row(plane.F(f, 0)), plane.X.row(plane.F(f, 1)),
                                   plane.X.row(plane.F(f, 2)))
                    .z(),
                0.0);
    }
  }
}

// The error of a quantity on a coarse mesh, divided by the error on a mesh of half the edge length:
// 4 at second order.
double error_ratio(double coarse, double fine, double exact) {
  return (coarse - exact) / (fine - exact);
}

double area_of(const TriangleMesh& mesh) {
  return surface_area(mesh.X, mesh.F);
}

TEST(Shapes, CurvedOnesApproachTheirAreaAndVolumeAtSecondOrder) {
  const auto check = [](const TriangleMesh& coarse, const TriangleMesh& fine, double area,
                        double volume) {
    EXPECT_NEAR(error_ratio(surface_area(coarse.X, coarse.F), surface_area(fine.X, fine.F), area),
                4.0, 0.1);
    EXPECT_NEAR(
        error_ratio(enclosed_volume(coarse.X, coarse.F), enclosed_volume(fine.X, fine.F), volume),
        4.0, 0.1);
  };
  check(make_icosphere({3}), make_icosphere({4}), 4.0 * pi, 4.0 / 3.0 * pi);
  check(make_cubesphere({3}), make_cubesphere({4}), 4.0 * pi, 4.0 / 3.0 * pi);
  for (const bool straight : {false, true}) {
    const double catenoid_area = pi * (2.0 + std::sinh(2.0));
    EXPECT_NEAR(error_ratio(area_of(make_catenoid(2.0, {21, 60, straight})),
                            area_of(make_catenoid(2.0, {41, 120, straight})), catenoid_area),
                4.0, 0.1);
    for (const double ratio : {1.2, std::sqrt(2.0), 2.5}) {
      check(make_torus(ratio, {40, 60, straight}), make_torus(ratio, {80, 120, straight}),
            4.0 * pi * pi / ratio, 2.0 * pi * pi / (ratio * ratio));
    }
    const TriangleMesh coarse = make_cylinder(3.0, {21, 40, straight});
    const TriangleMesh fine = make_cylinder(3.0, {41, 80, straight});
    EXPECT_NEAR(
        error_ratio(surface_area(coarse.X, coarse.F), surface_area(fine.X, fine.F), 6.0 * pi), 4.0,
        0.1);
  }
}

TEST(Shapes, JitterKeepsVerticesOnTheSurfaceAndIsReproducible) {
  const double ratio = 2.5;
  const auto grid = [](std::uint64_t seed) { return GridSize{12, 30, false, {0.3, seed}}; };
  const TriangleMesh torus = make_torus(ratio, grid(1)), catenoid = make_catenoid(2.0, grid(1));
  const auto from_axis = [](const TriangleMesh& mesh) {
    return mesh.X.leftCols<2>().rowwise().norm().array().eval();
  };
  EXPECT_LT(((from_axis(torus) - 1).square() + torus.X.col(2).array().square() - 1 / ratio / ratio)
                .abs()
                .maxCoeff(),
            1e-14);
  EXPECT_LT((from_axis(catenoid) - catenoid.X.col(2).array().cosh()).abs().maxCoeff(), 1e-14);
  EXPECT_EQ(catenoid.X.topRows(30).col(2).maxCoeff(), -1);  // its borders stay circles
  EXPECT_EQ(torus.X, make_torus(ratio, grid(1)).X);
  EXPECT_NE(torus.X, make_torus(ratio, grid(2)).X);

  TriangleMesh sphere = make_cubesphere({3});
  const Points before = sphere.X;
  jitter_on_unit_sphere(sphere.X, sphere.F, {0.2, 1});
  EXPECT_LT((sphere.X.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  EXPECT_GT((sphere.X - before).rowwise().norm().mean(), 0.01);
  EXPECT_THROW(jitter_on_unit_sphere(sphere.X, sphere.F, {0.5, 1}), BadOption);
  EXPECT_THROW(make_torus(ratio, {12, 30, false, {-0.1, 1}}), BadOption);
  EXPECT_THROW(make_catenoid(21, {}), BadOption);
}

TEST(Shapes, SubdivisionKeepsTheVerticesThatStand) {
  const auto check = [](TriangleMesh (*make)(const Subdivision&)) {
    const TriangleMesh coarse = make({2});
    const TriangleMesh fine = make({3});
    const TriangleMesh refined = make({2, 5});
    EXPECT_EQ(coarse.X, fine.X.topRows(coarse.X.rows()));
    EXPECT_EQ(coarse.X, refined.X.topRows(coarse.X.rows()));
  };
  check(make_icosahedron);
  check(make_icosphere);
  check(make_cube);
  check(make_hexagon);
  const TriangleMesh sphere = make_icosphere({4});
  EXPECT_EQ(sphere.X.rows(), 2562);
  EXPECT_EQ(sphere.F.rows(), 5120);
  EXPECT_NEAR(sphere.X.rowwise().norm().minCoeff(), 1.0, 1e-15);
  EXPECT_NEAR(sphere.X.rowwise().norm().maxCoeff(), 1.0, 1e-15);
}

// Red refinement gives 4 children for each triangle of the face; green refinement gives 2 for each
// triangle across the border of the face.
TEST(Shapes, RefiningAFaceSplitsItAndItsNeighboursOnly) {
  for (const int levels : {0, 1, 3}) {
    const Eigen::Index side = 1 << levels;
    const TriangleMesh before = make_icosahedron({levels});
    const TriangleMesh after = make_icosahedron({levels, 4});
    EXPECT_EQ(after.F.rows(), before.F.rows() + 3 * side * side + 3 * side);
    EXPECT_EQ(after.X.rows(), before.X.rows() + 3 * side * (side + 1) / 2);
  }
}

// The marked sets leave triangles with two split edges, so that the closure has work to do.
TEST(Shapes, SplittingAnyMarkedSetIsConforming) {
  const TriangleMesh base = make_icosphere({2});
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(base.F.rows()));
    RandomNumbers random(seed);
    for (std::uint8_t& mark : marked) {
      mark = random.uniform() < 0.125 * seed ? 1 : 0;
    }
    const TriangleMesh split = split_triangles(base, marked);
    const Topology topology = build_topology(split.X, split.F);
    EXPECT_TRUE(topology.defects.empty());
    EXPECT_EQ(topology.euler_characteristic(), 2);
    EXPECT_EQ(topology.boundary_loops.size(), 0U);
    EXPECT_EQ(topology.turned_triangles, 0);
    EXPECT_NEAR(surface_area(split.X, split.F), surface_area(base.X, base.F), 1e-12);
  }
}

TEST(Shapes, DefaultGridsAreNearEquilateral) {
  for (const double ratio : {1.1, 2.0, 9.0}) {
    const auto mean_angle = [](const TriangleMesh& mesh) {
      return smallest_angles(mesh.X, mesh.F).mean() * 180.0 / pi;
    };
    EXPECT_GT(mean_angle(make_cylinder(ratio, {})), 55.0);
    EXPECT_GT(mean_angle(make_cylinder(ratio, {33, {}})), 55.0);
    EXPECT_GT(mean_angle(make_plane(ratio, {})), 50.0);
    EXPECT_GT(mean_angle(make_plane(ratio, {{}, 50})), 50.0);
    EXPECT_GT(mean_angle(make_torus(3.0 * ratio, {})), 45.0);
    EXPECT_GT(mean_angle(make_torus(3.0 * ratio, {40, {}})), 45.0);
  }
}

TEST(Shapes, RefuseWhatCannotBeMade) {
  EXPECT_THROW(make_icosahedron({-1}), BadOption);
  EXPECT_THROW(make_icosphere({13}), BadOption);
  EXPECT_THROW(make_icosphere({12}), BadOption);  // too large
  EXPECT_THROW(make_icosahedron({1, 20}), BadOption);
  EXPECT_THROW(make_icosahedron({1, -1}), BadOption);
  EXPECT_THROW(make_torus(1.0, {}), BadOption);
  EXPECT_THROW(make_torus(std::nan(""), {}), BadOption);
  EXPECT_THROW(make_torus(2.0, {5, 8}), BadOption);  // rows shifted by half a cell must be even
  EXPECT_NO_THROW(make_torus(2.0, {5, 8, true}));
  EXPECT_THROW(make_torus(2.0, {4, 2}), BadOption);
  EXPECT_THROW(make_torus(2.0, {100000, 100000}), BadOption);
  EXPECT_THROW(make_torus(2.0, {{}, 2000000000}), BadOption);
  EXPECT_THROW(make_cylinder(0.0, {}), BadOption);
  EXPECT_THROW(make_cylinder(1e6, {{}, 1000000}), BadOption);
  EXPECT_THROW(make_plane(1.0, {1, 5}), BadOption);
  EXPECT_THROW(make_shape("icospher"), BadOption);
  EXPECT_THROW(make_shape("torus", {.subdivide = 2}), BadOption);
  EXPECT_THROW(make_shape("cube", {.straight = true}), BadOption);
}

TEST(Shapes, EveryRowOfTheTableCanBeMade) {
  std::set<std::string_view> names;
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    EXPECT_TRUE(names.insert(shape.name).second);
    const Mesh mesh = make_shape(shape.name);
    EXPECT_GT(mesh.faces.size(), 0);
    EXPECT_TRUE(mesh.X.allFinite());
  }
  EXPECT_GE(names.size(), 5U);
}

// These values were computed once and must never change: users' scripts rely on a seed giving these
// bits.
TEST(Noise, IsTheSameForEver) {
  RandomNumbers random(0);
  EXPECT_EQ(random.integer(), 0x99ec5f36cb75f2b4U);  // splitmix64 seed 0, as in the authors' code
  Points X = Points::Zero(1, 3);
  add_noise(X, 1.0, 1);
  EXPECT_EQ(X, (Points(1, 3) << -0x1.f6662c9691348p-1, 0x1.1f5af66920d2cp-3, -0x1.25da86d3a4e32p+0)
                   .finished());
  Points again = Points::Zero(1, 3);
  add_noise(again, 1.0, 1);
  EXPECT_EQ(X, again);
  add_noise(again, 1.0, 2);
  EXPECT_NE(X, again);
}

TEST(Noise, IsNormal) {
  constexpr int count = 300000;
  RandomNumbers random(7);
  std::vector<double> values(count);
  double moment[5] = {};
  for (double& value : values) {
    value = random.normal();
    for (int k = 1; k <= 4; ++k) {
      moment[k] += std::pow(value, k) / count;
    }
  }
  // The tolerance of each moment is five standard errors.
  const double error = 5.0 / std::sqrt(count);
  EXPECT_NEAR(moment[1], 0.0, error);
  EXPECT_NEAR(moment[2], 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(moment[3], 0.0, error * std::sqrt(15.0));
  EXPECT_NEAR(moment[4], 3.0, error * std::sqrt(96.0));
  // Kolmogorov-Smirnov test: the largest scaled distance between the distributions exceeds 2.2 in
  // one of 10000 samples.
  std::sort(values.begin(), values.end());
  double distance = 0.0;
  for (int i = 0; i < count; ++i) {
    const double expected = 0.5 * std::erfc(-values[static_cast<std::size_t>(i)] / std::sqrt(2.0));
    distance = std::max({distance, std::abs(expected - static_cast<double>(i) / count),
                         std::abs(expected - (i + 1.0) / count)});
  }
  EXPECT_LT(distance * std::sqrt(count), 2.2);
}

}  // namespace
}  // namespace ibmfair
