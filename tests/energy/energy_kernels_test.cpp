// The kernels over blocks and fans give the plain sum over the stencils to rounding, on every class
// of meshes; the tests run with both sets of kernels.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/shapes/grids.h"
#include "support/meshes.h"
#include "support/plain_energies.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// Closed and open surfaces, defects, a vertex of many triangles, and a mesh of several blocks,
/// each at all scales and far from the origin.
std::vector<NamedMesh> meshes() {
  GridSize size;
  size.rows = 100;
  size.columns = 90;
  const TriangleMesh torus = make_torus(2, size);
  std::vector<NamedMesh> all = all_meshes();
  all.push_back({"vertices of 100 triangles", barrel(100)});
  all.push_back({"several blocks", mesh_from_triangles(torus.X, torus.F)});
  for (NamedMesh& named : all) {
    named.mesh = in_triangles(named.mesh);
  }
  return at_all_scales(all);
}

/// Checks the energy and its gradient against plain(stencils, X), relative to their size.
template <class Plain>
void expect_plain_sum(const std::string& model, const EnergyOptions& options, State state,
                      const Plain& plain) {
  const auto energy = bending_model(model).create(state.topology, options);
  const auto expect_at = [&](const Points& X, double tolerance) {
    const PlainEnergy expected = plain(energy->stencils(), X);
    Points G;
    EXPECT_NEAR(energy->energy_and_gradient(X, G), expected.E, tolerance * expected.E);
    EXPECT_NEAR(energy->energy(X), expected.E, tolerance * expected.E);
    EXPECT_LE((G - expected.G).norm(), tolerance * expected.G.norm());
  };
  state.X = shaken(state, 0.05);
  expect_at(state.X, 1e-13);
  // In the sum over a thin triangle's corners, terms cancel that are larger by 1 / height^2.
  for (const double height : {1e-3, 1e-5}) {
    expect_at(with_needle(state, 0, height), 1e-16 / (height * height));
  }
}

class EnergyKernels : public testing::TestWithParam<bool> {};

TEST_P(EnergyKernels, OfStarsGiveThePlainSum) {
  const bool mass = GetParam();
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    expect_plain_sum(
        "lagrange", {.mass = mass}, State(mesh),
        [&](const auto& stars, const auto& X) { return plain_lagrange(stars, X, mass); });
  }
}

TEST_P(EnergyKernels, OfStarsWithSpontaneousCurvatureGiveThePlainSum) {
  const bool mass = GetParam();
  for (const auto& [name, mesh] : at_all_scales(good_meshes())) {
    SCOPED_TRACE(name);
    const State state(in_triangles(mesh));
    const PerVertex H0 =
        random_directions(state.X.rows(), 7).col(0) / mean_edge_length(state.X, state.topology.E);
    expect_plain_sum(
        "lagrange", {.mass = mass, .spontaneous_curvature = H0}, state,
        [&](const auto& stars, const auto& X) { return plain_lagrange(stars, X, mass, H0); });
  }
}

TEST_P(EnergyKernels, OfHingesGiveThePlainSum) {
  const bool mass = GetParam();
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    for (const Mesh& oriented : {mesh, with_mixed_orientation(mesh)}) {
      expect_plain_sum("crouzeix-raviart", {.mass = mass}, State(oriented),
                       [&](const auto& hinges, const auto& X) {
                         return plain_crouzeix_raviart(hinges, X, mass);
                       });
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Mass, EnergyKernels, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "with" : "without");
});

TEST(SharpHinges, GiveThePlainSum) {
  constexpr double angle = std::numbers::pi / 6;
  const double bound = 2 * std::sqrt(3.0) * (1 - std::cos(angle));
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    expect_plain_sum("crouzeix-raviart", {.sharp_angle = angle}, State(mesh),
                     [&](const auto& hinges, const auto& X) {
                       return plain_crouzeix_raviart(hinges, X, true, 1 / bound);
                     });
  }
}

}  // namespace
}  // namespace ibmfair::test
