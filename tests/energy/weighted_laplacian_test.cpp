// The Laplacian of weighted triangulations, [W07] (6).
#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/circle_weights.h"
#include "ibmfair/energy/vertex_laplacians.h"
#include "support/family.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::unique_ptr<BendingEnergy> weighted(const Topology& topology, std::vector<double> weights) {
  return bending_model("weighted").create(topology, {true, {}, {}, std::move(weights)});
}

TEST(WeightedLaplacian, WithEqualWeightsIsTheCotangentOne) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    const Points X = shaken(state, 0.05);
    Points G, G_weighted;
    const double E =
        Member{"lagrange", "barycentric"}.create(state.topology)->energy_and_gradient(X, G);
    const double edge = mean_edge_length(X, state.topology.E);
    for (const double weight : {0.0, edge * edge}) {
      const auto energy = weighted(state.topology, std::vector<double>(X.rows(), weight));
      EXPECT_NEAR(energy->energy_and_gradient(X, G_weighted), E, 1e-11 * E) << name;
      EXPECT_LE((G_weighted - G).norm(), 1e-10 * G.norm() + 1e-300) << name;
    }
  }
}

/// The point of the plane that has the same power |c - x|^2 - w with respect to three other points.
Eigen::Vector2d power_centre(const std::array<Eigen::Vector2d, 3>& x, const ByCorner<double>& w) {
  Eigen::Matrix2d A;
  Eigen::Vector2d b;
  for (int k = 0; k < 2; ++k) {
    A.row(k) = 2 * (x[k + 1] - x[0]).transpose();
    b[k] = x[k + 1].squaredNorm() - w[k + 1] - x[0].squaredNorm() + w[0];
  }
  return A.inverse() * b;
}

// [W07] (6): the share of a triangle in the weight of an edge is the signed height of the
// triangle's power centre over the edge, divided by the edge's length.
TEST(WeightedLaplacian, MeasuresTheHeightOfThePowerCentre) {
  const Points random = random_directions(200, 4);
  for (Index n = 0; n < 50; ++n) {
    const std::array<Eigen::Vector2d, 3> x{random.row(n).head<2>(), random.row(50 + n).head<2>(),
                                           random.row(100 + n).head<2>()};
    TriangleShape<double> shape =
        triangle_shape({x[0][0], x[0][1], 0}, {x[1][0], x[1][1], 0}, {x[2][0], x[2][1], 0});
    shape.weight = {random(150 + n, 0), random(150 + n, 1), random(150 + n, 2)};
    const Eigen::Vector2d c = power_centre(x, shape.weight);
    const ByCorner<double> shares = PowerCentreWeights::at(shape);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d a = x[next(k)], edge = x[previous(k)] - a;
      const Eigen::Vector2d inward(-edge[1], edge[0]);
      const double side = inward.dot(x[k] - a) > 0 ? 1 : -1;
      const double ratio = side * inward.dot(c - a) / edge.squaredNorm();
      EXPECT_NEAR(shares[k], ratio, 1e-9 * (1 + std::abs(ratio)) / shape.area);
    }
  }
}

/// A triangle whose corners' circles touch: edges r0 + r1, r1 + r2, r2 + r0.
TEST(WeightedLaplacian, OfTouchingCirclesHasItsCentresInTheInscribedOnes) {
  const double r0 = 1, r1 = 2, r2 = 5;
  const double c = r0 + r1, a = r1 + r2, b = r2 + r0;
  const double x = (b * b + c * c - a * a) / (2 * c);
  TriangleShape<double> shape =
      triangle_shape({0, 0, 0}, {c, 0, 0}, {x, std::sqrt(b * b - x * x), 0});
  shape.weight = {r0 * r0, r1 * r1, r2 * r2};
  const double inradius = 2 * shape.area / (a + b + c);
  const ByCorner<double> shares = PowerCentreWeights::at(shape);
  EXPECT_NEAR(shares[0], inradius / a, 1e-14);
  EXPECT_NEAR(shares[1], inradius / b, 1e-14);
  EXPECT_NEAR(shares[2], inradius / c, 1e-14);
}

TEST(WeightedLaplacian, RefusesWeightsThatAreNoNumberForEveryVertex) {
  const State state(flat_sheet(2, 2));
  std::vector<double> weights(8, 0);
  EXPECT_THROW(weighted(state.topology, weights), BadOption);
  weights.resize(9, std::nan(""));
  EXPECT_THROW(weighted(state.topology, weights), BadOption);
}

}  // namespace
}  // namespace ibmfair::test
