// Twicing smooths the removed part as well and adds it back. The tests check which part twicing
// adds back, and that the promises of the flow also hold with twicing.
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

Points repeated(const State& state, int times, const FlowOptions& options) {
  State now = state;
  for (int i = 0; i < times; ++i) {
    willmore_flow(now.X, now.topology, fixed_vertices(now.topology, BoundaryCondition::fixed),
                  options);
  }
  return now.X;
}

// Over a flat sheet the flow of small heights is linear, z -> G z. Therefore n passes of twicing
// leave (1 - (1 - G)^(n + 1)) z: 2 G - G^2 after one pass and 3 G - 3 G^2 + G^3 after two. Without
// noise all steps of the flow are as long as the steps of the passes.
TEST(Twicing, OfSmallHeightsIsThePolynomialOfTheFlow) {
  State state(flat_sheet(24, 20));
  const double height = 1e-5;
  for (Eigen::Index v = 0; v < state.X.rows(); ++v) {
    state.X(v, 2) = height * (std::sin(7 * state.X(v, 0)) + std::cos(9 * state.X(v, 1)));
  }
  for (const char* laplacian : {"lagrange", "crouzeix-raviart"}) {
    FlowOptions options;
    options.laplacian = laplacian;
    options.relax = false;
    options.steps = 4;
    options.solver_tolerance = 1e-10;
    options.total_time = time_for_cutoff(7 * mean_edge_length(state.X, state.topology.E));
    const Eigen::VectorXd once = repeated(state, 1, options).col(2);
    const Eigen::VectorXd two = repeated(state, 2, options).col(2);
    const Eigen::VectorXd three = repeated(state, 3, options).col(2);
    options.twicing = 1;
    const Eigen::VectorXd twice = repeated(state, 1, options).col(2);
    options.twicing = 2;
    const Eigen::VectorXd thrice = repeated(state, 1, options).col(2);
    EXPECT_LT((twice - (2 * once - two)).cwiseAbs().maxCoeff(), 1e-5 * height) << laplacian;
    EXPECT_LT((thrice - (3 * once - 3 * two + three)).cwiseAbs().maxCoeff(), 1e-5 * height)
        << laplacian;
    EXPECT_GT((twice - once).cwiseAbs().maxCoeff(), 0.05 * height) << laplacian;
  }
}

/// Options of a flow with the umbrella Laplacian whose twicing also puts slides back.
FlowOptions umbrella_with_slides(int twicing) {
  FlowOptions options;
  options.laplacian = "umbrella";
  options.relax = false;
  options.twicing = twicing;
  options.put_back_slides = true;
  return options;
}

// The flow with the umbrella Laplacian is linear in each coordinate, X -> G X, however large the
// moves are. If slides are put back, too, the same polynomials hold for whole meshes.
TEST(Twicing, WithSlidesIsThePolynomialOfTheUmbrellasFlow) {
  for (const char* shape : {"torus", "cylinder"}) {
    State state(make_shape(shape, {.rows = 20}));
    state.X = shaken(state, 0.1);
    FlowOptions options = umbrella_with_slides(0);
    options.guarded = false;
    options.steps = 8;
    options.solver_tolerance = 1e-10;
    const double edge = mean_edge_length(state.X, state.topology.E);
    options.total_time =
        time_in_flow_units(time_for_cutoff(8 * edge), state.X, state.topology, options);
    const Points once = repeated(state, 1, options);
    const Points two = repeated(state, 2, options);
    const Points three = repeated(state, 3, options);
    const auto error_with = [&](int twicing, const Points& polynomial) {
      options.twicing = twicing;
      return (repeated(state, 1, options) - polynomial).cwiseAbs().maxCoeff();
    };
    EXPECT_LT(error_with(1, 2 * once - two), 1e-5 * edge) << shape;
    EXPECT_LT(error_with(2, 3 * once - 3 * two + three), 1e-5 * edge) << shape;
    options.put_back_slides = false;
    EXPECT_GT(error_with(1, 2 * once - two), 0.01 * edge) << shape;
  }
}

// The umbrella Laplacian makes vertices slide even if there is no noise.
TEST(Twicing, WithSlidesKeepsVerticesNearerToTheirPlaces) {
  for (const Mesh& mesh :
       {make_shape("icosphere", {.subdivide = 4}), make_shape("torus", {.rows = 24})}) {
    const State state(mesh);
    FlowOptions options = umbrella_with_slides(2);
    options.put_back_slides = false;
    const double slid = (run_flow(state, 12, options).X - state.X).norm();
    options.put_back_slides = true;
    EXPECT_LT((run_flow(state, 12, options).X - state.X).norm(), 0.9 * slid);
  }
}

/// A shape with noise, and the surface that it approximates.
struct Noisy {
  std::string name;
  State state;
  double volume;
  std::unique_ptr<ExactSurface> surface;

  Noisy(std::string shape, const ShapeSettings& settings, std::unique_ptr<ExactSurface> exact)
      : name(std::move(shape)),
        state(make_shape(name, settings)),
        volume(enclosed_volume(state.X, state.topology.F)),
        surface(std::move(exact)) {
    state.X = shaken(state, 0.2);
  }

  double volume_change(const Points& X) const {
    return std::abs(enclosed_volume(X, state.topology.F) / volume - 1);
  }

  double error(const Points& X) const {
    double squares = 0;
    for (const auto& x : X.rowwise()) {
      squares += std::pow(surface->signed_distance(x), 2);
    }
    return std::sqrt(squares / static_cast<double>(X.rows()));
  }
};

TEST(Twicing, KeepsTheSizeOfSpheresAndToriAndComesNearerToThem) {
  std::vector<Noisy> shapes;
  shapes.emplace_back("icosphere", ShapeSettings{.subdivide = 4},
                      std::make_unique<ExactSphere>(Vec3::Zero(), 1));
  shapes.emplace_back("torus", ShapeSettings{.ratio = 2.5, .rows = 40},
                      std::make_unique<ExactTorus>(Vec3::Zero(), 1, 0.4));
  for (const Noisy& noisy : shapes) {
    for (const char* laplacian : {"crouzeix-raviart", "umbrella"}) {
      FlowOptions options;
      options.laplacian = laplacian;
      options.relax = laplacian != std::string("umbrella");
      const FlowRun once = run_flow(noisy.state, 12, options);
      options.twicing = 1;
      const FlowRun twice = run_flow(noisy.state, 12, options);
      EXPECT_EQ(once.report.twicings, 0);
      EXPECT_EQ(twice.report.twicings, 1);
      EXPECT_LT(noisy.volume_change(twice.X), 0.4 * noisy.volume_change(once.X))
          << noisy.name << " " << laplacian;
      // The Willmore flow has nothing to take from a sphere.
      const bool kept = noisy.name == "icosphere" && laplacian != std::string("umbrella");
      EXPECT_LT(noisy.error(twice.X), (kept ? 1.1 : 0.7) * noisy.error(once.X))
          << noisy.name << " " << laplacian;
    }
  }
}

TEST(Twicing, KeepsThePromisesOfTheFlowOnEveryMesh) {
  for (const auto& [name, mesh] : all_meshes()) {
    State state(mesh);
    if (mean_edge_length(state.X, state.topology.E) <= 0) {
      continue;
    }
    state.X = shaken(state, 0.2);
    for (const char* laplacian : {"crouzeix-raviart", "lagrange", "umbrella"}) {
      FlowOptions options;
      options.laplacian = laplacian;
      options.steps = 4;
      options.twicing = 2;
      options.put_back_slides = laplacian == std::string("umbrella");
      const FlowRun result = run_flow(state, 5, options);
      EXPECT_TRUE(result.X.allFinite()) << name;
      EXPECT_LE(result.report.energy_after, result.report.energy_before) << name;
      const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
      const Unknowns unknowns(fixed);
      const FoldWatch folds(state.X, state.topology);
      EXPECT_TRUE(folds.new_folds(result.X).empty()) << name << " " << laplacian;
      for (Eigen::Index v = 0; v < state.X.rows(); ++v) {
        if (fixed[v]) {
          EXPECT_EQ(result.X.row(v), state.X.row(v)) << name;
        }
      }
    }
  }
}

TEST(Twicing, KeepsBoundsOnMovesVolumeAndArea) {
  State state(make_shape("icosphere", {.subdivide = 3}));
  state.X = shaken(state, 0.2);
  const Triangles& F = state.topology.F;
  FlowOptions options;
  options.twicing = 1;
  options.max_move = 0.1 * mean_edge_length(state.X, state.topology.E);
  const FlowRun bounded = run_flow(state, 8, options);
  EXPECT_LE((bounded.X - state.X).rowwise().norm().maxCoeff(), options.max_move * (1 + 1e-12));
  EXPECT_EQ(bounded.report.twicings, 1);
  options.max_move = std::numeric_limits<double>::infinity();
  options.keep_volume = options.keep_area = true;
  for (const bool slides : {false, true}) {
    options.laplacian = slides ? "umbrella" : "crouzeix-raviart";
    options.relax = !slides;
    options.put_back_slides = slides;
    const FlowRun kept = run_flow(state, 8, options);
    EXPECT_EQ(kept.report.twicings, 1);
    EXPECT_NEAR(enclosed_volume(kept.X, F) / enclosed_volume(state.X, F), 1, 1e-12);
    EXPECT_NEAR(surface_area(kept.X, F) / surface_area(state.X, F), 1, 1e-12);
  }
}

// If every pass kept the volume, the flow would end in another shape: the thinner a torus is
// compared with the cut-off, the further away.
TEST(Twicing, WithSlidesKeepsTheVolumeAtTheEndOnly) {
  const Noisy torus("torus", {.ratio = 2.5, .rows = 40, .columns = 100},
                    std::make_unique<ExactTorus>(Vec3::Zero(), 1, 0.4));
  const double volume = enclosed_volume(torus.state.X, torus.state.topology.F);
  FlowOptions options = umbrella_with_slides(20);
  const double free = torus.error(run_flow(torus.state, 18, options).X);
  options.keep_volume = true;
  const FlowRun kept = run_flow(torus.state, 18, options);
  EXPECT_NEAR(enclosed_volume(kept.X, torus.state.topology.F) / volume, 1, 1e-12);
  EXPECT_LT(torus.error(kept.X), 1.2 * free);
  EXPECT_LE(kept.report.energy_after, kept.report.energy_before);
}

TEST(Twicing, WithSlidesKeepsTheVolumeOfAFlowThatIsInterrupted) {
  State state(make_shape("icosphere", {.subdivide = 3}));
  state.X = shaken(state, 0.2);
  FlowOptions options = umbrella_with_slides(2);
  options.keep_volume = options.keep_area = true;
  const double time = time_for_cutoff(8 * mean_edge_length(state.X, state.topology.E));
  options.total_time = time_in_flow_units(time, state.X, state.topology, options);
  Points X = state.X;
  const FlowReport report =
      willmore_flow(X, state.topology, fixed_vertices(state.topology, BoundaryCondition::fixed),
                    options, [](const StepRecord& step) { return step.step < 2; });
  EXPECT_EQ(report.status, FlowStatus::interrupted);
  EXPECT_EQ(report.twicings, 0);
  EXPECT_LT(report.energy_after, report.energy_before);
  const Triangles& F = state.topology.F;
  EXPECT_NEAR(enclosed_volume(X, F) / enclosed_volume(state.X, F), 1, 1e-12);
  EXPECT_NEAR(surface_area(X, F) / surface_area(state.X, F), 1, 1e-12);
}

TEST(Twicing, WithSlidesFactorsOnceForAllPasses) {
  State state(make_shape("torus", {.rows = 24}));
  state.X = shaken(state, 0.2);
  FlowOptions options = umbrella_with_slides(1);
  options.solver = "multifrontal";
  const FlowReport one = run_flow(state, 10, options).report;
  options.twicing = 9;
  const FlowReport nine = run_flow(state, 10, options).report;
  EXPECT_EQ(nine.factorizations, one.factorizations);
  EXPECT_EQ(nine.solves, one.solves + 8 * options.twicing_steps());
}

TEST(Twicing, DoesNotDependOnTheSolver) {
  State state(make_shape("torus", {.rows = 24}));
  state.X = shaken(state, 0.2);
  FlowOptions options;
  options.twicing = 1;
  options.solver_tolerance = 1e-6;
  options.solver = "multifrontal";
  const Points direct = run_flow(state, 10, options).X;
  options.solver = "cg";
  const Points iterative = run_flow(state, 10, options).X;
  EXPECT_LT((direct - iterative).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace ibmfair::test
