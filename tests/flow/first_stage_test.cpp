// The first stage of a flow that keeps creases removes spikes of noise before the flow keeps hinges
// that are as sharp as these spikes. The tests check when there is such a stage and what the stage
// achieves.
#include "ibmfair/flow/first_stage.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/states.h"
#include "support/thin_states.h"

namespace ibmfair::test {
namespace {

State noisy(const std::string& shape, double noise_in_edges) {
  State state(make_shape(shape, {.subdivide = 4}));
  add_noise(state.X, noise_in_edges * mean_edge_length(state.X, state.topology.E), 3);
  return state;
}

FlowOptions keeping_creases(const State& state, double cutoff_edges) {
  FlowOptions options;
  options.steps = 8;
  options.sharp_angle = 20 * degree;
  const double time = time_for_cutoff(cutoff_edges * mean_edge_length(state.X, state.topology.E));
  options.total_time = time_in_flow_units(time, state.X, state.topology, options);
  return options;
}

TEST(FirstStage, IsForNoiseWhereCreasesAreKept) {
  for (const char* shape : {"icosphere", "cube", "icosahedron"}) {
    const State clean = noisy(shape, 0), rough = noisy(shape, 0.2);
    const auto stage_of = [](const State& state, const FlowOptions& options) {
      const std::vector<std::uint8_t> fixed(state.X.rows(), 0);
      return first_stage_options(
          FlowProblem(state.X, state.topology, fixed, options, MeshParts::one()));
    };
    EXPECT_FALSE(stage_of(clean, keeping_creases(clean, 8))) << shape;
    FlowOptions options = keeping_creases(rough, 8);
    ASSERT_TRUE(stage_of(rough, options)) << shape;
    for (const double cutoff : {3, 8, 20}) {
      const FlowOptions whole = keeping_creases(rough, cutoff);
      const auto stage = stage_of(rough, whole);
      EXPECT_LE(stage->total_time, 0.25 * whole.total_time * (1 + 1e-12)) << shape;
      EXPECT_LE(stage->total_time, keeping_creases(rough, 3).total_time) << shape;
      EXPECT_GT(stage->sharp_angle, whole.sharp_angle);
    }
    for (const bool relax : {true, false}) {
      options.relax_first = relax;
      options.relax = !relax;
      EXPECT_EQ(stage_of(rough, options)->relax, relax);
    }
    options.guarded = false;
    EXPECT_FALSE(stage_of(rough, options));
    options.guarded = true;
    for (const double angle : {0.0, 60 * degree, 90 * degree}) {
      options.sharp_angle = angle;
      EXPECT_FALSE(stage_of(rough, options)) << angle;
    }
  }
}

TEST(FirstStage, LeavesNoSpikesOfNoiseOnTheFacesOfACube) {
  const State clean = noisy("cube", 0);
  const Eigen::VectorXd flat = dihedral_angles(clean.X, clean.topology.H);
  for (const double noise : {0.1, 0.2, 0.3}) {
    for (const bool relax_later : {true, false}) {
      SCOPED_TRACE(std::to_string(noise) + (relax_later ? ", relaxed" : ", relaxed at first"));
      const State rough = noisy("cube", noise);
      FlowOptions options = keeping_creases(rough, 8);
      options.relax = relax_later;
      const FlowRun run = run_flow(rough, 8, options);
      const Eigen::VectorXd angles = dihedral_angles(run.X, clean.topology.H);
      Index spiky = 0, edges = 0, round = 0;
      for (Eigen::Index h = 0; h < angles.size(); ++h) {
        const bool on_face = flat[h] > 135 * degree;
        spiky += on_face && angles[h] < 140 * degree;
        edges += !on_face;
        round += !on_face && angles[h] > 120 * degree;
      }
      EXPECT_LE(spiky, angles.size() / 200);
      EXPECT_LE(round, edges / 5);
      EXPECT_LE(run.report.energy_after, run.report.energy_before);
    }
  }
}

TEST(FirstStage, EndsWhereTheObserverAsksForIt) {
  const State rough = noisy("cube", 0.2);
  const auto fixed = fixed_vertices(rough.topology, BoundaryCondition::fixed);
  const FlowOptions options = keeping_creases(rough, 8);
  for (const int last : {1, 3, 5}) {
    Points X = rough.X;
    int first = 0, all = 0;
    const FlowReport report =
        willmore_flow(X, rough.topology, fixed, options, [&](const StepRecord& step) {
          first += step.step == 0;
          EXPECT_EQ(step.time == 0, step.step == 0);
          return ++all < last;
        });
    EXPECT_EQ(report.status, FlowStatus::interrupted);
    EXPECT_EQ(all, last);
    EXPECT_EQ(first + static_cast<int>(report.steps.size()), last);
    EXPECT_GE(first, std::min(last, 3));
    EXPECT_LT(report.energy_after, report.energy_before);
    EXPECT_NE(X, rough.X);
  }
}

}  // namespace
}  // namespace ibmfair::test
