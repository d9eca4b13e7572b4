// Noise by the angles of hinges: parts with edges, round shapes, and shapes of which hinges tell
// nothing.
#include "ibmfair/flow/settings/hinge_noise.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/correlated_noise.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::vector<std::uint8_t> all_free(const State& state) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(state.X.rows()), 0);
}

/// The noise that is found, in mean edge lengths.
double found_in(const State& state) {
  return noise_by_hinges(state.X, state.topology, all_free(state)) / edge_of(state);
}

std::vector<NamedMesh> parts_and_round_shapes() {
  return {{"coarse cube", make_shape("cube", {.subdivide = 3})},
          {"cube", make_shape("cube", {.subdivide = 5})},
          {"sphere", make_shape("icosphere", {.subdivide = 5})},
          {"torus", make_shape("torus", {.rows = 60, .columns = 150})},
          {"plane", make_shape("plane", {.rows = 40, .columns = 40})}};
}

TEST(HingeNoise, IsThatOfTheMesh) {
  for (const auto& [name, mesh] : parts_and_round_shapes()) {
    for (const double noise : {0.1, 0.15, 0.2}) {
      State state(mesh);
      add_noise(state.X, noise * edge_of(state), 1);
      EXPECT_NEAR(found_in(state), noise, 0.12 * noise) << name;
    }
  }
}

TEST(HingeNoise, IsUnknownWhereHingesDiffer) {
  for (const auto& [name, mesh] : parts_and_round_shapes()) {
    EXPECT_LT(found_in(State(mesh)), 0.05) << name;
    if (name == "sphere" || name == "torus") {
      continue;  // curved by as much as weak noise
    }
    State state(mesh);
    Points noisy = state.X;
    add_noise(noisy, 0.2 * edge_of(state), 1);
    const double middle = state.X.col(0).mean();
    for (Index v = 0; v < state.X.rows(); ++v) {
      if (state.X(v, 0) < middle) {
        state.X.row(v) = noisy.row(v);
      }
    }
    EXPECT_EQ(found_in(state), 0) << name;
  }
}

TEST(HingeNoise, IsThatOfTheFreeVertices) {
  State state(make_shape("cube", {.subdivide = 5}));
  std::vector<std::uint8_t> fixed = all_free(state);
  Points noisy = state.X;
  add_noise(noisy, 0.1 * edge_of(state), 1);
  for (Index v = 0; v < state.X.rows(); ++v) {
    fixed[v] = state.X(v, 0) > 0;
    if (!fixed[v]) {
      state.X.row(v) = noisy.row(v);
    }
  }
  const double found = noise_by_hinges(state.X, state.topology, fixed) / edge_of(state);
  EXPECT_NEAR(found, 0.1, 0.012);
  EXPECT_EQ(noise_by_hinges(state.X, state.topology, std::vector<std::uint8_t>(fixed.size(), 1)),
            0);
}

TEST(HingeNoise, GrowsWithTheMesh) {
  State state(make_shape("cube", {.subdivide = 4}));
  add_noise(state.X, 0.1 * edge_of(state), 1);
  const double found = noise_by_hinges(state.X, state.topology, all_free(state));
  for (const double scale : {1e-8, 1e8}) {
    EXPECT_NEAR(noise_by_hinges(scale * state.X, state.topology, all_free(state)), scale * found,
                1e-9 * scale * found);
  }
}

TEST(HingeNoise, OfAnyMeshIsFinite) {
  for (const auto& [name, mesh] : all_meshes()) {
    EXPECT_TRUE(std::isfinite(found_in(State(mesh)))) << name;
  }
}

}  // namespace
}  // namespace ibmfair::test
