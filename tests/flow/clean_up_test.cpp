// At its end, a flow of the whole mesh finishes the regions that it had slowed down: these regions
// catch up, and folds are undone.
#include "ibmfair/flow/passes/clean_up.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::int64_t folds_in(const Points& X, const Topology& topology) {
  const std::vector<std::uint8_t> folded = folded_hinges(X, topology);
  return std::ranges::count(folded, 1);
}

State sphere() {
  return State(make_shape("icosphere", {.subdivide = 4}));
}

/// A sphere that is noisy only within two rings of one vertex. This spot lags behind the flow.
class LaggingSpot : public testing::Test {
 protected:
  static constexpr Index middle = 1000;

  LaggingSpot() {
    const Points noisy = shaken(sphere_, 0.3);
    for (Index v = 0; v < sphere_.topology.vertex_count; ++v) {
      if (near_[v]) {
        X_.row(v) = noisy.row(v);
      }
    }
  }

  const State sphere_ = sphere();
  const CompressedRows rings_ = vertex_rings(sphere_.topology);
  const std::vector<std::uint8_t> near_ = around(sphere_.topology, {middle}, 2);
  Points X_ = sphere_.X;
  const FlowOptions options_{
      .total_time = time_for_cutoff(6 * mean_edge_length(sphere_.X, sphere_.topology.E))};
};

TEST_F(LaggingSpot, CatchesUpAndMovesNothingElse) {
  FlowProblem problem(X_, sphere_.topology, std::vector<std::uint8_t>(near_.size(), 0), options_,
                      MeshParts::one());
  problem.report.time_reached = options_.total_time;
  Eigen::VectorXd deficit = Eigen::VectorXd::Zero(X_.rows());
  Points move;
  EXPECT_FALSE(catch_up_moves(problem, rings_, deficit, move)) << "nothing lags behind";
  deficit[middle] = options_.total_time;
  ASSERT_TRUE(catch_up_moves(problem, rings_, deficit, move));
  for (Index v = 0; v < move.rows(); ++v) {
    EXPECT_TRUE(near_[v] || move.row(v).isZero(0)) << v;
  }
  const double smooth = bending_energy(sphere_.X, sphere_.topology, options_.laplacian);
  EXPECT_GT(problem.energy(), 1.2 * smooth);
  EXPECT_LT(problem.energy_at(X_ + move), 1.001 * smooth);
}

/// The spheres are crumpled so much that nearly all steps slow some vertices down.
TEST(CleanUp, LeavesMuchLessEnergyAndNoMoreFolds) {
  std::int64_t caught_up = 0;
  double cleaned_energy = 0, left_energy = 0;
  for (const char* laplacian : {"crouzeix-raviart", "lagrange"}) {
    for (const int seed : {1, 2, 3, 4}) {
      SCOPED_TRACE(std::string(laplacian) + ", noise " + std::to_string(seed));
      State state = sphere();
      add_noise(state.X, 0.8 * mean_edge_length(state.X, state.topology.E), seed);
      FlowOptions options;
      options.laplacian = laplacian;
      const FlowRun cleaned = run_flow(state, 6, options);
      options.clean_up = false;
      const FlowRun left = run_flow(state, 6, options);
      EXPECT_LE(cleaned.report.energy_after, left.report.energy_after);
      EXPECT_EQ(cleaned.report.steps.back().energy, cleaned.report.energy_after);
      EXPECT_EQ(left.report.caught_up + left.report.unfolded, 0);
      EXPECT_LE(folds_in(cleaned.X, state.topology), folds_in(left.X, state.topology));
      caught_up += cleaned.report.caught_up;
      cleaned_energy += cleaned.report.energy_after;
      left_energy += left.report.energy_after;
    }
  }
  EXPECT_GT(caught_up, 0);
  EXPECT_LT(cleaned_energy, 0.6 * left_energy);
}

/// Long after the last step that slowed vertices down, the flow has nothing to catch up with.
TEST(CleanUp, HasNothingToDoAfterManySteps) {
  State state(make_shape("torus", {.ratio = 2.5, .rows = 20, .columns = 50}));
  add_noise(state.X, 0.5 * mean_edge_length(state.X, state.topology.E), 1);
  const FlowRun run = run_flow(state, 5, {.steps = 400});
  EXPECT_TRUE(std::ranges::any_of(run.report.steps,
                                  [](const StepRecord& step) { return step.held_back > 0; }));
  EXPECT_EQ(run.report.caught_up, 0);
}

}  // namespace
}  // namespace ibmfair::test
