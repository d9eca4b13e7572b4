// If a step of the whole mesh goes wrong at some vertices, only these vertices are slowed down; the
// rest of the mesh does not wait for them.
#include "ibmfair/flow/steps/uphill_vertices.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

State torus() {
  return State(make_shape("torus", {.ratio = 2.5, .rows = 40, .columns = 100}));
}

class TheUphillVertices : public testing::Test {
 protected:
  const State state_ = torus();
  const FlowOptions options_{.total_time = 1};
  const FlowProblem problem_{state_.X, state_.topology,
                             std::vector<std::uint8_t>(state_.X.rows(), 0), options_,
                             MeshParts::one()};
  const Points move_ = random_directions(problem_.unknowns.size());
  Points gradient_ = -move_;  // downhill everywhere
};

TEST_F(TheUphillVertices, AreFoundBesideThoseOfUnknownSlope) {
  for (const Index u : {3, 500, 1701}) {
    gradient_.row(u) = move_.row(u);
  }
  gradient_.row(40) = 1e-3 * move_.row(40);  // a negligible slope
  gradient_(60, 1) = std::numeric_limits<double>::quiet_NaN();
  std::vector<Index> expected;
  for (const Index u : {3, 60, 500, 1701}) {
    expected.push_back(problem_.unknowns.vertex[u]);
  }
  const UphillVertices found = find_uphill_vertices(problem_, gradient_, move_);
  EXPECT_TRUE(found.are_local);
  EXPECT_EQ(found.vertices, expected);
}

TEST_F(TheUphillVertices, AreNotLocalWhereThereAreNone) {
  const UphillVertices found = find_uphill_vertices(problem_, gradient_, move_);
  EXPECT_FALSE(found.are_local);
  EXPECT_TRUE(found.vertices.empty());
}

TEST_F(TheUphillVertices, AreNoLocalTroubleWhereThereAreMany) {
  for (Index u = 0; u < gradient_.rows() / 10; ++u) {
    gradient_.row(u) = move_.row(u) / move_.row(u).squaredNorm();
  }
  const UphillVertices found = find_uphill_vertices(problem_, gradient_, move_);
  EXPECT_FALSE(found.are_local);
  EXPECT_EQ(found.vertices.size(), static_cast<std::size_t>(gradient_.rows() / 10));
}

/// Moves about ten vertices, if they are free to move, past their first neighbours by half the
/// length of the edge between them.
Points with_tangles(const State& state) {
  Points X = state.X;
  const CompressedRows rings = vertex_rings(state.topology);
  const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
  const Index stride = state.topology.vertex_count / 10;
  for (Index v = stride / 2; v < state.topology.vertex_count; v += stride) {
    if (!fixed[v]) {
      X.row(v) += 1.5 * (state.X.row(rings[v].front()) - state.X.row(v));
    }
  }
  return X;
}

TEST(TangledSpots, HoldUpNothingElse) {
  for (State state : {torus(), State(make_shape("icosphere", {.subdivide = 4})),
                      State(make_shape("cylinder", {.rows = 40, .columns = 80}))}) {
    FlowOptions options;
    options.solver = "multifrontal";
    const FlowRun clean = run_flow(state, 8, options);
    state.X = with_tangles(state);
    const FlowRun tangled = run_flow(state, 8, options);
    EXPECT_EQ(tangled.report.status, FlowStatus::completed);
    EXPECT_EQ(tangled.report.rejected, 0);
    EXPECT_EQ(tangled.report.steps.size(), static_cast<std::size_t>(options.steps));
    EXPECT_TRUE(std::ranges::any_of(tangled.report.steps,
                                    [](const StepRecord& step) { return step.held_back > 0; }));
    EXPECT_LT(tangled.report.energy_after, 1.01 * clean.report.energy_after);
  }
}

/// On these spheres, nearly every step is slowed down at some vertices.
TEST(CrumpledSpheres, AreSpheresAgainAfterFewSteps) {
  for (const int subdivide : {2, 3}) {
    for (const double noise : {0.7, 1.0}) {
      State state(make_shape("icosphere", {.subdivide = subdivide}));
      add_noise(state.X, noise * mean_edge_length(state.X, state.topology.E), 1);
      const FlowRun run = run_flow(state, 100, {});
      EXPECT_EQ(run.report.status, FlowStatus::completed);
      EXPECT_LT(run.report.energy_after, 1.01 * 8 * std::numbers::pi);
      EXPECT_LT(run.report.solves, 100) << subdivide << ", noise " << noise;
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
