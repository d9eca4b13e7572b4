// The published flow one step at a time: the same states as when it runs through, whatever the
// numbering of the mesh, with one factorization.
#include "ibmfair/flow/stepwise_flow.h"

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/noise.h"
#include "support/flow_run.h"
#include "support/renumbered.h"

namespace ibmfair::test {
namespace {

State noisy_torus(bool scattered) {
  GridSize size;
  size.rows = 150;  // more than fits into the cache, so that a scattered mesh is renumbered
  size.columns = 200;
  TriangleMesh mesh = make_torus(2.5, size);
  add_noise(mesh.X, 0.001, 1);
  if (scattered) {
    mesh = renumbered(mesh, permutation(mesh.X.rows(), 3));
  }
  return State(mesh_from_triangles(mesh.X, mesh.F));
}

FlowOptions plain_options(const State& state, int steps) {
  FlowOptions options;
  options.laplacian = "lagrange";
  options.guarded = false;
  options.relax = false;
  options.steps = steps;
  options.solver_tolerance = 1e-8;
  const double time = time_for_cutoff(6 * mean_edge_length(state.X, state.topology.E));
  options.total_time = time_in_flow_units(time, state.X, state.topology, options);
  return options;
}

class StepwiseFlows : public testing::TestWithParam<bool> {};

TEST_P(StepwiseFlows, MakesTheStepsOfThePlainFlow) {
  const State state = noisy_torus(GetParam());
  const FlowOptions options = plain_options(state, 4);
  const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
  Points expected = state.X;
  const FlowReport report = willmore_flow(expected, state.topology, fixed, options);
  StepwiseFlow flow(state.X, state.topology, fixed, options);
  EXPECT_TRUE(flow.positions() == state.X);
  for (const StepRecord& record : report.steps) {
    const auto step = flow.step();
    ASSERT_TRUE(step);
    EXPECT_EQ(step->step, record.step);
    EXPECT_NEAR(step->energy, record.energy, 1e-9 * record.energy);
    EXPECT_EQ(flow.report().energy_after, step->energy);
  }
  EXPECT_LE((flow.positions() - expected).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(flow.report().factorizations, report.factorizations);
}

TEST_P(StepwiseFlows, StartsAgainWithItsFactorization) {
  const State state = noisy_torus(GetParam());
  const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
  StepwiseFlow flow(state.X, state.topology, fixed, plain_options(state, 4));
  ASSERT_TRUE(flow.step());
  const Points first = flow.positions();
  const int factorizations = flow.report().factorizations;
  ASSERT_TRUE(flow.step());
  flow.move_to(state.X);
  EXPECT_TRUE(flow.positions() == state.X);
  ASSERT_TRUE(flow.step());
  EXPECT_LE((flow.positions() - first).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(flow.report().factorizations, factorizations);
}

INSTANTIATE_TEST_SUITE_P(Numbering, StepwiseFlows, testing::Bool(),
                         [](const auto& info) { return info.param ? "scattered" : "by_rows"; });

TEST(StepwiseFlow, RefusesMeshesThatCannotMoveAndStatesWithoutEnergy) {
  const State state = noisy_torus(false);
  const FlowOptions options = plain_options(state, 4);
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(state.X.rows()), 1);
  EXPECT_THROW(StepwiseFlow(state.X, state.topology, all, options), BadMesh);
  StepwiseFlow flow(state.X, state.topology, std::vector<std::uint8_t>(all.size(), 0), options);
  EXPECT_THROW(flow.move_to(Points::Zero(state.X.rows(), 3)), BadMesh);
  EXPECT_THROW(flow.move_to(state.X.topRows(7)), BadMesh);
  EXPECT_TRUE(flow.positions() == state.X);
}

}  // namespace
}  // namespace ibmfair::test
