// The smallest and the largest eigenvalue of every Laplacian of the family.
#include "ibmfair/solve/spectrum.h"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/polyhedra.h"
#include "support/family.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

using std::numbers::pi;

class LaplacianSpectra : public testing::TestWithParam<Member> {
 protected:
  static SpectrumEnds ends(const Points& X, const Topology& topology) {
    return spectrum_ends(GetParam().matrices(X, topology));
  }

  static SpectrumEnds ends(const TriangleMesh& mesh) {
    return ends(mesh.X, build_topology(mesh.X, mesh.F));
  }

  /// Whether the member of the family approximates the Laplace-Beltrami operator.
  static bool is_consistent() {
    return GetParam().measures_area() && GetParam().is_flat_on_planes();
  }
};

INSTANTIATE_TEST_SUITE_P(Family, LaplacianSpectra, testing::ValuesIn(family()),
                         [](const auto& tested) { return identifier(tested.param); });

TEST_P(LaplacianSpectra, EndsAreThoseOfTheDenseMatrices) {
  for (const auto& [name, mesh] : good_meshes()) {
    const State state(mesh);
    if (state.X.rows() > 150) {
      continue;
    }
    const Points X = shaken(state, 0.05);
    const LaplacianMatrices matrices = GetParam().matrices(X, state.topology);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        dense(matrices.L), dense(matrices.M), Eigen::EigenvaluesOnly);
    const SpectrumEnds found = spectrum_ends(matrices);
    EXPECT_EQ(found.zeros, state.topology.component_count) << name;
    ASSERT_TRUE(found.smallest && found.largest) << name;
    EXPECT_NEAR(*found.smallest / solver.eigenvalues()[found.zeros], 1, 1e-8) << name;
    EXPECT_NEAR(*found.largest / solver.eigenvalues()[found.nodes - 1], 1, 1e-8) << name;
  }
}

TEST_P(LaplacianSpectra, ScaleWithTheInverseOfArea) {
  const State state(closed_meshes()[3].mesh);
  const SpectrumEnds one = ends(state.X, state.topology);
  for (const double scale : {1e-3, 1e3}) {
    const SpectrumEnds other = ends(scale * state.X, state.topology);
    const double factor = GetParam().measures_area() ? scale * scale : 1;
    EXPECT_NEAR(*other.smallest * factor / *one.smallest, 1, 1e-8);
    EXPECT_NEAR(*other.largest * factor / *one.largest, 1, 1e-8);
  }
}

// The first eigenvalue of the sphere is l (l + 1) with l = 1; it occurs three times.
TEST_P(LaplacianSpectra, FirstEigenvalueOfTheSphereTendsToTwoAtSecondOrderAtLeast) {
  if (!is_consistent()) {
    GTEST_SKIP() << "not an approximation of the Laplace-Beltrami operator";
  }
  const double coarse = std::abs(*ends(make_icosphere({2})).smallest - 2);
  const double fine = std::abs(*ends(make_icosphere({3})).smallest - 2);
  EXPECT_LT(fine, 0.015);
  EXPECT_GT(coarse / fine, 3.6);
}

// Without boundary conditions, the first eigenvalue of a square of side 1 is pi^2; it occurs twice.
TEST_P(LaplacianSpectra, FirstEigenvalueOfTheSquareTendsToItsOwnAtSecondOrder) {
  if (!is_consistent()) {
    GTEST_SKIP() << "not an approximation of the Laplace-Beltrami operator";
  }
  for (const bool straight : {false, true}) {
    const double coarse = std::abs(*ends(make_plane(1, {12, 11, straight})).smallest - pi * pi);
    const double fine = std::abs(*ends(make_plane(1, {23, 21, straight})).smallest - pi * pi);
    EXPECT_LT(fine, 0.04);
    EXPECT_NEAR(coarse / fine, 4, 0.8);
  }
}

TEST_P(LaplacianSpectra, CountZerosByPartsHoweverSmallOrFarTheyAre) {
  const TriangleMesh ball = make_icosphere({1});
  constexpr int balls = 7;
  TriangleMesh many{Points(balls * ball.X.rows(), 3), Triangles(balls * ball.F.rows(), 3)};
  double scale = 1;
  for (int i = 0; i < balls; ++i, scale *= 3) {
    many.X.middleRows(i * ball.X.rows(), ball.X.rows()) =
        (scale * ball.X).rowwise() + Eigen::RowVector3d(3 * scale, 0, 0);
    many.F.middleRows(i * ball.F.rows(), ball.F.rows()) =
        ball.F.array() + static_cast<Index>(i * ball.X.rows());
  }
  const SpectrumEnds one = ends(ball), found = ends(many);
  EXPECT_EQ(found.zeros, balls);
  const double factor = GetParam().measures_area() ? std::pow(3, 2 * (balls - 1)) : 1;
  EXPECT_NEAR(*found.smallest * factor / *one.smallest, 1, 1e-7);  // of the largest ball
  EXPECT_NEAR(*found.largest / *one.largest, 1, 1e-7);             // of the smallest ball
}

}  // namespace
}  // namespace ibmfair::test
