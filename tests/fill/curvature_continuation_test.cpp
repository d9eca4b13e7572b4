// Patches that continue the curvature of the mesh around their holes.
#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/fill/fill_holes.h"
#include "support/holed_meshes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

Points new_vertices(const Mesh& mesh, bool continued) {
  FillOptions options;
  options.fairing.laplacian = "intrinsic-delaunay";
  options.continue_curvature = continued;
  const State state(mesh);
  const Filling filling = fill_holes(state.X, state.topology, {}, options);
  EXPECT_EQ(filling.holes.size(), 2u);  // the border and the hole
  for (const HoleReport& hole : filling.holes) {
    if (hole.new_triangles > 0) {
      EXPECT_EQ(hole.method.ends_with("with continued curvature"), continued) << hole.method;
    }
  }
  return filling.new_X;
}

/// The graph of a function over a sheet of an edge length of 1/24 with a square hole.
template <class Function>
Mesh graph(const Function& f) {
  Mesh mesh = with_square_hole(flat_sheet(24, 24), 4);
  for (auto x : mesh.X.rowwise()) {
    x[2] = f(x[0] - 0.5, x[1] - 0.5);
  }
  return mesh;
}

/// Root mean square of the vertical distance from the graph.
template <class Function>
double error(const Points& X, const Function& f) {
  double sum = 0;
  for (const auto x : X.rowwise()) {
    sum += std::pow(x[2] - f(x[0] - 0.5, x[1] - 0.5), 2);
  }
  return std::sqrt(sum / static_cast<double>(X.rows()));
}

TEST(ContinuedCurvature, APlaneStaysAPlane) {
  const auto plane = [](double x, double y) { return 0.3 * x - 0.2 * y; };
  EXPECT_LT(error(new_vertices(graph(plane), true), plane), 1e-13);
}

// The fourth powers are solutions of Laplace^3 u = 0, but not of Laplace^2 u = 0.
TEST(ContinuedCurvature, FollowsCurvatureThatChanges) {
  const auto along_x = [](double x, double) { return 3 * std::pow(x, 4); };
  const auto along_y = [](double, double y) { return -3 * std::pow(y, 4); };
  const auto across = [](double x, double y) { return 2 * (x * x * y * y + 0.5 * std::pow(y, 4)); };
  const auto check = [](const auto& f) {
    const double without = error(new_vertices(graph(f), false), f);
    EXPECT_LT(error(new_vertices(graph(f), true), f), 0.35 * without);
  };
  check(along_x);
  check(along_y);
  check(across);
}

TEST(ContinuedCurvature, MovesWithTheMesh) {
  const Mesh mesh = graph([](double x, double y) { return x * x * x - x * y + y * y; });
  const Points X = new_vertices(mesh, true);
  for (const double scale : {1e-8, 1.0, 1e8}) {
    SCOPED_TRACE(scale);
    const Vec3 offset = scale * Vec3(3, -1, 2);
    Mesh shape;
    shape.X = X;
    const Points expected = moved(shape, scale, offset).X;
    const Points found = new_vertices(moved(mesh, scale, offset), true);
    ASSERT_EQ(found.rows(), expected.rows());
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-5 * scale);
  }
}

}  // namespace
}  // namespace ibmfair::test
