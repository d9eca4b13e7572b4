// The limits of the energies under refinement, compared with exact values of smooth surfaces.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/shapes/shapes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

using std::numbers::pi;
constexpr double sphere_energy = 8 * pi;
constexpr double clifford_energy = 4 * pi * pi;

double icosphere_energy(int level, std::string_view model) {
  ShapeSettings settings;
  settings.subdivide = level;
  const State state(make_shape("icosphere", settings));
  return bending_energy(state.X, state.topology, model);
}

double torus_energy(Index rows, bool straight, std::string_view model) {
  ShapeSettings settings;  // the ratio is sqrt 2: the Clifford torus
  settings.rows = rows;
  settings.straight = straight;
  const State state(make_shape("torus", settings));
  return bending_energy(state.X, state.topology, model);
}

TEST(EnergyLimits, LagrangeConvergesToTheSphereAtSecondOrder) {
  // The differences of a prototype at levels 3 to 7 were -0.112, -0.0280, -0.00702, -0.00176,
  // -0.00044.
  double last = icosphere_energy(3, "lagrange") - sphere_energy;
  EXPECT_NEAR(last, -0.112, 0.001);
  for (int level = 4; level <= 7; ++level) {
    const double difference = icosphere_energy(level, "lagrange") - sphere_energy;
    EXPECT_NEAR(last / difference, 4, 0.1) << level;
    last = difference;
  }
  EXPECT_NEAR(last, -0.00044, 0.00001);
}

TEST(EnergyLimits, LagrangeConvergesToTheCliffordTorusOverAnyTriangulation) {
  for (const bool straight : {true, false}) {
    double last = torus_energy(32, straight, "lagrange") - clifford_energy;
    for (const Index rows : {64, 128, 256}) {
      const double difference = torus_energy(rows, straight, "lagrange") - clifford_energy;
      EXPECT_NEAR(last / difference, 4, 0.2) << rows << (straight ? " straight" : " staggered");
      last = difference;
    }
    EXPECT_LT(std::abs(last), 0.02);
  }
}

// On random triangulations of the sphere, the energy of the cotangent Laplacian has a limit of its
// own; on their intrinsic Delaunay triangulation its limit is the exact energy.
TEST(EnergyLimits, IntrinsicDelaunayConvergesToTheSphereOverRandomTriangulations) {
  const auto energy = [](int level, std::string_view model) {
    ShapeSettings settings;
    settings.subdivide = level;
    settings.jitter = 0.3;
    const State state(make_shape("icosphere", settings));
    return bending_energy(state.X, state.topology, model) - sphere_energy;
  };
  double last = energy(3, "intrinsic-delaunay");
  for (int level = 4; level <= 6; ++level) {
    const double difference = energy(level, "intrinsic-delaunay");
    EXPECT_NEAR(last / difference, 4, 0.2) << level;
    last = difference;
  }
  EXPECT_LT(std::abs(last), 0.003);
  EXPECT_GT(std::abs(energy(6, "lagrange")), 0.05);
}

TEST(EnergyLimits, CrouzeixRaviartConvergesToALimitThatDependsOnTheTriangulation) {
  // On equilateral triangles the limit is 3/4 of the integral of H^2 minus the integral of K. This
  // limit is 8 pi on the sphere; the twelve vertices of valence five and the unequal triangles of
  // an icosphere add 0.39.
  const double a = icosphere_energy(5, "crouzeix-raviart");
  const double b = icosphere_energy(6, "crouzeix-raviart");
  const double c = icosphere_energy(7, "crouzeix-raviart");
  EXPECT_NEAR(c, sphere_energy + 0.39, 0.01);
  EXPECT_LT(std::abs(c - b), std::abs(b - a));

  const double straight = torus_energy(256, true, "crouzeix-raviart");
  const double staggered = torus_energy(256, false, "crouzeix-raviart");
  EXPECT_NEAR(straight, torus_energy(128, true, "crouzeix-raviart"), 0.005 * straight);
  EXPECT_NEAR(staggered, torus_energy(128, false, "crouzeix-raviart"), 0.005 * staggered);
  EXPECT_GT(std::abs(straight - staggered), 10);
  EXPECT_GT(std::min(straight, staggered), 1.3 * clifford_energy);
  RecordProperty("straight", std::to_string(straight));
  RecordProperty("staggered", std::to_string(staggered));
}

}  // namespace
}  // namespace ibmfair::test
