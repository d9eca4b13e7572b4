// The choice of a cut-off from the noise: its estimates are compared with the known noise and
// errors of noisy shapes.
#include "ibmfair/flow/settings/cutoff_choice.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/crease_choice.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "ibmfair/shapes/subdivide.h"
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

  /// The squared error that a flow with this cut-off (a length) leaves.
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
                       fixed_vertices(state.topology, BoundaryCondition::fixed), options,
                       {.largest = largest});
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
      EXPECT_NEAR(choice.noise.deviation, noisy.noise, 0.15 * noisy.noise);
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

TEST(CutoffChoice, SaysHowSureItIsOfTheErrors) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    for (Noisy& noisy : noisy_shapes()) {
      SCOPED_TRACE(noisy.name);
      add_noise(noisy.state.X, noisy.noise, seed);  // in addition to that of the shape
      const FlowOptions options{.laplacian = "umbrella", .relax = false, .twicing = 1};
      const CutoffChoice choice = choice_for(noisy.state, noisy.diagonal / 2, options);
      const double left = noisy.squared_error_after(choice.best().cutoff, options);
      EXPECT_NEAR(choice.best().risk, left, 2 * choice.risk_error);
      EXPECT_LT(choice.risk_error, 0.15 * choice.noise.variance());
    }
  }
}

TEST(CutoffChoice, FindsAndTakesNextToNothingWithoutNoise) {
  for (const char* laplacian : {"crouzeix-raviart", "umbrella"}) {
    const Noisy clean("torus", {.ratio = 2.5, .rows = 40},
                      std::make_unique<ExactTorus>(Vec3::Zero(), 1, 0.4), 0);
    const FlowOptions options{.laplacian = laplacian, .relax = false};
    const CutoffChoice choice = choice_for(clean.state, clean.diagonal / 2, options);
    EXPECT_LT(choice.noise.deviation, 0.01 * clean.edge) << laplacian;
    EXPECT_LT(std::sqrt(clean.squared_error_after(choice.cutoff, options)), 0.01 * clean.edge)
        << laplacian;
  }
}

TEST(CutoffChoice, IsMadeForAPlane) {
  const State plane(make_shape("plane", {}));
  for (const double angle : {0.0, 0.35}) {
    FlowOptions options;
    options.sharp_angle = angle;
    const CutoffChoice choice = choice_for(plane, 1, options);
    EXPECT_EQ(choice.noise.deviation, 0) << angle;
    EXPECT_EQ(choice.best().risk, 0) << angle;
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
  options.keep_volume = true;  // a part of the mesh cannot keep the volume
  const auto fixed = fixed_vertices(noisy.state.topology, BoundaryCondition::fixed);
  const auto choice = [&](Index enough) {
    return choose_cutoff(
        noisy.state.X, noisy.state.topology, fixed, options,
        {.largest = noisy.diagonal / 2, .sample = {enough, choice_tuning.cutoff.felt_rings}});
  };
  const CutoffChoice whole = choice(noisy.state.topology.vertex_count), sample = choice(50'000);
  EXPECT_NE(sample.cutoff, whole.cutoff);
  EXPECT_NEAR(sample.noise.deviation, whole.noise.deviation, 0.03 * whole.noise.deviation);
  EXPECT_LE(std::sqrt(noisy.squared_error_after(sample.cutoff, options)),
            1.25 * std::sqrt(noisy.squared_error_after(whole.cutoff, options)));
}

TEST(CutoffChoice, PiecesThatAreAllRimTellNothing) {
  const State torus(make_shape("torus", {.ratio = 2.5, .rows = 24}));
  const auto fixed = fixed_vertices(torus.topology, BoundaryCondition::fixed);
  const auto choice = [&](Index enough) {
    return choose_cutoff(shaken(torus, 0.1), torus.topology, fixed, {},
                         {.largest = 1, .sample = {enough, choice_tuning.cutoff.felt_rings}})
        .cutoff;
  };
  EXPECT_EQ(choice(300), choice(torus.topology.vertex_count));
}

/// A noisy convex polyhedron with flat faces, and its distance to the polyhedron without noise.
struct NoisyPolyhedron {
  State state, faces;  // `faces` has one triangle per face
  double edge, noise;

  NoisyPolyhedron(const std::string& shape, double noise_in_edges)
      : state(make_shape(shape, {.subdivide = 5})),
        faces(make_shape(shape, {})),
        edge(mean_edge_length(state.X, state.topology.E)),
        noise(noise_in_edges * edge) {
    add_noise(state.X, noise, 3);
  }

  double squared_error_after(double cutoff, const FlowOptions& options) const {
    const double noisy_edge = mean_edge_length(state.X, state.topology.E);
    const Points X = run_flow(state, cutoff / noisy_edge, options).X;
    double squares = 0;
    for (const auto& x : X.rowwise()) {
      squares += std::pow(height_over_faces(x), 2);
    }
    return squares / static_cast<double>(X.rows());
  }

 private:
  double height_over_faces(const Vec3& x) const {
    double highest = -1;
    for (Index t = 0; t < faces.topology.F.rows(); ++t) {
      const Vec3 normal = double_area_vector(faces.X, faces.topology.F, t).normalized();
      const Vec3 corner = faces.X.row(faces.topology.F(t, 0));
      highest = std::max(highest, normal.dot(x - corner));
    }
    return highest;
  }
};

FlowOptions keeping_creases(double angle) {
  FlowOptions options;
  options.steps = 8;
  options.sharp_angle = angle;
  options.first_stage = FirstStage::normals;
  return options;
}

TEST(CutoffChoice, ComparesWhatIsLeftWhereCreasesAreKept) {
  for (const char* shape : {"cube", "icosahedron"}) {
    for (const double noise : {0.1, 0.2}) {
      SCOPED_TRACE(std::string(shape) + ", noise " + std::to_string(noise));
      const NoisyPolyhedron noisy(shape, noise);
      const FlowOptions options = keeping_creases(0.35);
      const CutoffChoice choice = choice_for(noisy.state, 2, options);
      EXPECT_NEAR(choice.noise.deviation, noisy.noise, 0.2 * noisy.noise);
      const double variance = noisy.noise * noisy.noise;
      const double at_best = noisy.squared_error_after(choice.best().cutoff, options);
      double least = at_best;
      for (const CutoffTrial& trial : choice.trials) {
        const double left = noisy.squared_error_after(trial.cutoff, options);
        EXPECT_NEAR(trial.risk - choice.best().risk, left - at_best, 0.3 * (variance + left))
            << trial.cutoff;
        least = std::min(least, left);
      }
      EXPECT_LE(std::sqrt(noisy.squared_error_after(choice.cutoff, options)),
                1.2 * std::sqrt(least) + 0.05 * noisy.noise);
    }
  }
}

/// The mean angle (radians) of the triangles to those of the true surface.
double mean_tilt(const Points& X, const State& truth) {
  const Triangles& F = truth.topology.F;
  double sum = 0;
  for (Index t = 0; t < F.rows(); ++t) {
    const Vec3 normal = double_area_vector(X, F, t).normalized();
    sum += std::acos(std::min(1.0, normal.dot(double_area_vector(truth.X, F, t).normalized())));
  }
  return sum / static_cast<double>(F.rows());
}

FlowOptions without_creases() {
  return {.laplacian = "umbrella", .steps = 8, .relax = false, .twicing = 1};
}

TEST(CreaseChoice, KeepsThoseOfPolyhedra) {
  for (const char* shape : {"cube", "icosahedron"}) {
    for (const double noise : {0.05, 0.2, 0.3}) {
      SCOPED_TRACE(std::string(shape) + ", noise " + std::to_string(noise));
      const NoisyPolyhedron noisy(shape, noise);
      const auto fixed = fixed_vertices(noisy.state.topology, BoundaryCondition::fixed);
      const CutoffChoice without = choice_for(noisy.state, 2, without_creases());
      const auto creases = choose_creases(noisy.state.X, noisy.state.topology, fixed,
                                          keeping_creases(0), without, {.largest = 2})
                               .choice;
      ASSERT_TRUE(creases);
      EXPECT_EQ(creases->cutoff.noise.deviation, without.noise.deviation);
      const double left =
          noisy.squared_error_after(creases->cutoff.cutoff, keeping_creases(creases->sharp_angle));
      const double left_without = noisy.squared_error_after(without.cutoff, without_creases());
      EXPECT_LT(std::sqrt(left), 0.6 * std::sqrt(left_without));
    }
  }
}

TEST(CreaseChoice, KeepsThoseOfACubeUnderNoiseThatFoldsTriangles) {
  const NoisyPolyhedron noisy("cube", 0.5);
  const auto fixed = fixed_vertices(noisy.state.topology, BoundaryCondition::fixed);
  const CutoffChoice without = choice_for(noisy.state, 2, without_creases());
  const auto creases = choose_creases(noisy.state.X, noisy.state.topology, fixed,
                                      keeping_creases(0), without, {.largest = 2})
                           .choice;
  ASSERT_TRUE(creases);
  const double left =
      noisy.squared_error_after(creases->cutoff.cutoff, keeping_creases(creases->sharp_angle));
  EXPECT_LT(left, 0.7 * noisy.squared_error_after(without.cutoff, without_creases()));
}

/// Flows that round blunt creases leave hardly more of the distance, but tilt the faces.
TEST(CreaseChoice, KeepsBluntOnes) {
  State truth(make_shape("icosphere", {.subdivide = 1}));  // hinges of 18 and 22.5 degrees
  for (int i = 0; i < 4; ++i) {
    const TriangleMesh split = split_all_triangles({truth.X, truth.topology.F});
    truth.X = split.X;
    truth.topology = build_topology(split.X, split.F);
  }
  State noisy = truth;
  add_noise(noisy.X, 0.1 * mean_edge_length(truth.X, truth.topology.E), 3);
  const auto fixed = fixed_vertices(truth.topology, BoundaryCondition::fixed);
  const CutoffChoice without = choice_for(noisy, 1, without_creases());
  const auto creases =
      choose_creases(noisy.X, noisy.topology, fixed, keeping_creases(0), without, {.largest = 1})
          .choice;
  ASSERT_TRUE(creases);
  const double edge = mean_edge_length(noisy.X, noisy.topology.E);
  const auto tilt = [&](double cutoff, const FlowOptions& options) {
    return mean_tilt(run_flow(noisy, cutoff / edge, options).X, truth);
  };
  EXPECT_LT(tilt(creases->cutoff.cutoff, keeping_creases(creases->sharp_angle)),
            0.8 * tilt(without.cutoff, without_creases()));
}

TEST(CreaseChoice, FindsNoneInSmoothShapes) {
  for (const Noisy& noisy : noisy_shapes()) {
    const auto fixed = fixed_vertices(noisy.state.topology, BoundaryCondition::fixed);
    const CutoffChoice without = choice_for(noisy.state, noisy.diagonal / 2, without_creases());
    const CreaseFindings found =
        choose_creases(noisy.state.X, noisy.state.topology, fixed, keeping_creases(0), without,
                       {.largest = noisy.diagonal / 2});
    EXPECT_FALSE(found.choice) << noisy.name;
  }
}

TEST(CutoffChoice, NeedsAVertexThatMoves) {
  const State sphere(make_shape("icosphere", {.subdivide = 2}));
  const std::vector<std::uint8_t> all(sphere.X.rows(), 1);
  EXPECT_THROW(choose_cutoff(sphere.X, sphere.topology, all, {}, {.largest = 1}), BadMesh);
}

}  // namespace
}  // namespace ibmfair::test
