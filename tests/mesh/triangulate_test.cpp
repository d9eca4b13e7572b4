// Every polygon is cut into triangles that cover it, whatever its shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/mesh.h"
#include "support/meshes.h"

namespace ibmfair::test {
namespace {

Mesh polygon(const std::vector<std::array<double, 2>>& corners, double tilt = 0.6) {
  Mesh mesh;
  mesh.X.resize(static_cast<Eigen::Index>(corners.size()), 3);
  std::vector<Index> face;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    mesh.X.row(static_cast<Eigen::Index>(i)) << corners[i][0], corners[i][1] * std::cos(tilt),
        corners[i][1] * std::sin(tilt);
    face.push_back(static_cast<Index>(i));
  }
  mesh.faces.add(face);
  return mesh;
}

double signed_area(const std::vector<std::array<double, 2>>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return sum;
}

/// The triangles cover the polygon without folding exactly if their areas add up to the polygon's
/// area.
void expect_covered(const std::vector<std::array<double, 2>>& corners) {
  const Mesh mesh = polygon(corners);
  const Triangulation T = triangulate(mesh);
  ASSERT_EQ(T.F.rows(), static_cast<Eigen::Index>(corners.size()) - 2);
  const double area = std::abs(signed_area(corners));
  EXPECT_NEAR(surface_area(mesh.X, T.F), area, 1e-12 * area);
}

TEST(Triangulate, LeavesTrianglesAlone) {
  Mesh mesh = polygon({{0, 0}, {1, 0}, {0, 1}});
  mesh.faces.add(std::vector<Index>{2, 2, 0});
  const Triangulation T = triangulate(mesh);
  ASSERT_EQ(T.F.rows(), 2);
  EXPECT_EQ(T.F.row(0), (Eigen::RowVector3i(0, 1, 2)));
  EXPECT_EQ(T.F.row(1), (Eigen::RowVector3i(2, 2, 0)));
  EXPECT_EQ(T.face, (std::vector<Index>{0, 1}));
}

TEST(Triangulate, CutsQuadrilateralsAlongTheBetterDiagonal) {
  const Triangulation wide = triangulate(polygon({{0, 0}, {1, -0.3}, {2, 0}, {1, 0.3}}));
  EXPECT_EQ(wide.F.row(0), (Eigen::RowVector3i(0, 1, 3)));
  const Triangulation tall = triangulate(polygon({{0, 0}, {1, -3}, {2, 0}, {1, 3}}));
  EXPECT_EQ(tall.F.row(0), (Eigen::RowVector3i(0, 1, 2)));
  // Arrowheads, with the notch at each corner in turn.
  std::vector<std::array<double, 2>> arrow{{0, 0}, {2, -1}, {0.5, 0}, {2, 1}};
  for (int turn = 0; turn < 4; ++turn) {
    expect_covered(arrow);
    std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
  }
}

TEST(Triangulate, CoversConcavePolygons) {
  expect_covered({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  for (const int teeth : {3, 10, 100}) {
    std::vector<std::array<double, 2>> comb;
    std::vector<std::array<double, 2>> star;
    for (int i = 0; i < teeth; ++i) {
      comb.push_back({2.0 * i, 10.0});
      comb.push_back({2.0 * i + 1, 1.0});
    }
    comb.push_back({2.0 * teeth, 0.0});
    comb.push_back({0.0, 0.0});
    for (int i = 0; i < 2 * teeth; ++i) {
      const double angle = std::numbers::pi * i / teeth;
      const double radius = i % 2 == 0 ? 1.0 : 0.3;
      star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    for (int turned = 0; turned < 2; ++turned) {
      expect_covered(comb);
      expect_covered(star);
      std::reverse(comb.begin(), comb.end());
      std::reverse(star.begin(), star.end());
    }
  }
}

TEST(Triangulate, CoversPolygonsWithABridgeToTheirHole) {
  std::vector<std::array<double, 2>> keyhole;
  constexpr int n = 24;
  for (int i = 0; i <= n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % n) / n;
    keyhole.push_back({3 * std::cos(angle), 3 * std::sin(angle)});
  }
  for (int i = n; i >= 0; --i) {
    const double angle = 2.0 * std::numbers::pi * (i % n) / n;
    keyhole.push_back({std::cos(angle), std::sin(angle)});
  }
  expect_covered(keyhole);
}

TEST(Triangulate, CoversPolygonsWithStraightCorners) {
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  const Mesh mesh = polygon({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}});
  EXPECT_TRUE(degenerate_triangles(mesh.X, triangulate(mesh).F).empty());
}

TEST(Triangulate, EndsForEveryPolygon) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<std::array<double, 2>>> odd{
      {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}},              // a point
      {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5, 0}, {0.5, 0}},  // a line
      {{0, 0}, {1, 1}, {1, 0}, {0, 1}},                      // a bow-tie
      {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 5}},              // crossing
      {{0, 0}, {nan, 1}, {1, 0}, {0, infinity}, {3, 3}, {1, 2}},
      {{0, 0}, {1e300, 0}, {1e300, 1e300}, {0, 1e300}, {-1e300, 5}},
      {{0, 0}, {1e-300, 0}, {1e-300, 1e-300}, {0, 1e-300}, {-1e-300, 0}}};
  std::vector<std::array<double, 2>> random;
  random.reserve(1500);
  for (int i = 0; i < 1500; ++i) {
    random.push_back({std::sin(1.0 + i * i), std::cos(3.0 + 7.0 * i * i)});
  }
  odd.push_back(random);
  for (int i = 0; i < 100000; ++i)
    random.push_back({i * 0.5, i % 7 * 1.0});
  odd.push_back(random);
  for (const auto& corners : odd) {
    const Mesh mesh = polygon(corners);
    const Triangulation T = triangulate(mesh);
    EXPECT_EQ(T.F.rows(), static_cast<Eigen::Index>(corners.size()) - 2);
    EXPECT_EQ(triangulate(mesh).F, T.F);
    std::vector<int> used(corners.size(), 0);
    for (Eigen::Index f = 0; f < T.F.rows(); ++f) {
      for (int c = 0; c < 3; ++c)
        ++used.at(static_cast<std::size_t>(T.F(f, c)));
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  }
}

TEST(Triangulate, RepeatedCornersStay) {
  Mesh mesh = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  std::vector<Index> round(936);
  for (Index i = 0; i < 936; ++i)
    round[i] = i % 4;
  mesh.faces.add(round);
  EXPECT_EQ(triangulate(mesh).F.rows(), 2 + 934);
}

TEST(MeshFromTriangles, IsTheInverse) {
  for (const NamedMesh& named : all_meshes()) {
    SCOPED_TRACE(named.name);
    const Triangulation T = triangulate(named.mesh);
    const Mesh mesh = mesh_from_triangles(named.mesh.X, T.F);
    EXPECT_EQ(mesh.X, named.mesh.X);
    EXPECT_EQ(triangulate(mesh).F, T.F);
  }
}

}  // namespace
}  // namespace ibmfair::test
