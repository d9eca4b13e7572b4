// The choice of a cut-off by the noise: what it tells against what is known of noisy shapes.
#include "ibmfair/flow/cutoff_choice.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/renumbered.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// A shape with noise of a known standard deviation, and the surface that it approximates.
struct Noisy {
  std::string name;
  State state;
  double edge, diagonal, noise;
  std::unique_ptr<ExactSurface> surface;

  Noisy(const std::string& shape, const ShapeSettings& settings,
        std::unique_ptr<ExactSurface> exact, double noise_in_edges)
      : name(shape + ", noise " + std::to_string(noise_in_edges)),
        state(make_shape(shape, settings)),
        edge(mean_edge_length(state.X, state.topology.E)),
        diagonal((state.X.colwise().maxCoeff() - state.X.colwise().minCoeff()).norm()),
        noise(noise_in_edges * edge),
        surface(std::move(exact)) {
    add_noise(state.X, noise, 3);
  }

  double squared_error(const Points& X) const {
    double squares = 0;
    for (const auto& x : X.rowwise()) {
      squares += std::pow(surface->signed_distance(x), 2);
    }
    return squares / static_cast<double>(X.rows());
  }

  /// That a flow with this cut-off (length) leaves.
  double squared_error_after(double cutoff, const FlowOptions& options) const {
    const double noisy_edge = mean_edge_length(state.X, state.topology.E);
    return squared_error(run_flow(state, cutoff / noisy_edge, options).X);
  }
};

std::vector<Noisy> noisy_shapes() {
  std::vector<Noisy> shapes;
  for (const double noise : {0.03, 0.1, 0.25}) {
    shapes.emplace_back("icosphere", ShapeSettings{.subdivide = 4},
                        std::make_unique<ExactSphere>(Vec3::Zero(), 1), noise);
    shapes.emplace_back("torus", ShapeSettings{.ratio = 2.5, .rows = 40},
                        std::make_unique<ExactTorus>(Vec3::Zero(), 1, 0.4), noise);
  }
  return shapes;
}

CutoffChoice choice_for(const State& state, double largest, const FlowOptions& options) {
  return choose_cutoff(state.X, state.topology,
                       held_vertices(state.topology, BoundaryCondition::fixed), options, largest);
}

TEST(CutoffChoice, TellsTheNoiseAndTheErrorsAndLeavesLittleMoreThanTheBestCutoff) {
  for (const Noisy& noisy : noisy_shapes()) {
    for (const auto& [laplacian, twicing] :
         {std::pair{"crouzeix-raviart", 0}, {"umbrella", 1}, {"lagrange", 2}}) {
      SCOPED_TRACE(noisy.name + ", " + laplacian);
      FlowOptions options;
      options.laplacian = laplacian;
      options.relax = laplacian != std::string("umbrella");
      options.twicing = twicing;
      const CutoffChoice choice = choice_for(noisy.state, noisy.diagonal / 2, options);
      EXPECT_NEAR(choice.noise, noisy.noise, 0.15 * noisy.noise);
      const double variance = noisy.noise * noisy.noise;
      double least = variance;
      for (const CutoffTrial& trial : choice.trials) {
        const double left = noisy.squared_error_after(trial.cutoff, options);
        EXPECT_NEAR(trial.risk, left, 0.25 * (variance + left)) << trial.cutoff;
        least = std::min(least, left);
      }
      EXPECT_LE(std::sqrt(noisy.squared_error_after(choice.cutoff, options)),
                1.2 * std::sqrt(least) + 0.05 * noisy.noise);
    }
  }
}

TEST(CutoffChoice, FindsAndTakesNextToNothingWithoutNoise) {
  for (const char* laplacian : {"crouzeix-raviart", "umbrella"}) {
    const Noisy clean("torus", {.ratio = 2.5, .rows = 40},
                      std::make_unique<ExactTorus>(Vec3::Zero(), 1, 0.4), 0);
    const FlowOptions options{.laplacian = laplacian, .relax = false};
    const CutoffChoice choice = choice_for(clean.state, clean.diagonal / 2, options);
    EXPECT_LT(choice.noise, 0.01 * clean.edge) << laplacian;
    EXPECT_LT(std::sqrt(clean.squared_error_after(choice.cutoff, options)), 0.01 * clean.edge)
        << laplacian;
  }
}

TEST(CutoffChoice, IsOfTheMeshAndNotOfItsUnitNumbersOrThreads) {
  const Noisy noisy("torus", {.ratio = 2.5, .rows = 24}, nullptr, 0.2);
  const int before = thread_count();
  set_thread_count(1);
  const CutoffChoice choice = choice_for(noisy.state, 1, {});
  set_thread_count(3);
  EXPECT_EQ(choice_for(noisy.state, 1, {}).cutoff, choice.cutoff);
  set_thread_count(before);

  State larger = noisy.state;
  larger.X *= 8;
  EXPECT_NEAR(choice_for(larger, 8, {}).cutoff, 8 * choice.cutoff, 1e-6 * choice.cutoff);

  const std::vector<Index> number = permutation(noisy.state.X.rows(), 5);
  const TriangleMesh other = renumbered({noisy.state.X, noisy.state.topology.F}, number);
  const State same(mesh_from_triangles(other.X, other.F));
  EXPECT_NEAR(choice_for(same, 1, {}).cutoff, choice.cutoff, 0.1 * choice.cutoff);
}

TEST(CutoffChoice, ASampleTellsAboutWhatTheWholeMeshTells) {
  const Noisy noisy("torus", {.ratio = 2.5, .rows = 192},
                    std::make_unique<ExactTorus>(Vec3::Zero(), 1, 0.4), 0.2);
  FlowOptions options{.laplacian = "umbrella", .steps = 8, .relax = false, .twicing = 1};
  options.keep_volume = true;  // which a part cannot
  const auto held = held_vertices(noisy.state.topology, BoundaryCondition::fixed);
  const auto choice = [&](Index enough) {
    return choose_cutoff(noisy.state.X, noisy.state.topology, held, options, noisy.diagonal / 2, {},
                         enough);
  };
  const CutoffChoice whole = choice(noisy.state.topology.vertex_count), sample = choice(50'000);
  EXPECT_NE(sample.cutoff, whole.cutoff);
  EXPECT_NEAR(sample.noise, whole.noise, 0.03 * whole.noise);
  EXPECT_LE(std::sqrt(noisy.squared_error_after(sample.cutoff, options)),
            1.25 * std::sqrt(noisy.squared_error_after(whole.cutoff, options)));
}

TEST(CutoffChoice, PiecesThatAreAllRimTellNothing) {
  const State torus(make_shape("torus", {.ratio = 2.5, .rows = 24}));
  const auto held = held_vertices(torus.topology, BoundaryCondition::fixed);
  const auto choice = [&](Index enough) {
    return choose_cutoff(shaken(torus, 0.1), torus.topology, held, {}, 1, {}, enough).cutoff;
  };
  EXPECT_EQ(choice(300), choice(torus.topology.vertex_count));
}

TEST(CutoffChoice, NeedsAVertexThatMoves) {
  const State sphere(make_shape("icosphere", {.subdivide = 2}));
  const std::vector<std::uint8_t> all(sphere.X.rows(), 1);
  EXPECT_THROW(choose_cutoff(sphere.X, sphere.topology, all, {}, 1), BadMesh);
}

}  // namespace
}  // namespace ibmfair::test
