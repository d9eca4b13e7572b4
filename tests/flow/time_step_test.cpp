// The time steps of the guarded flow: noise does not make the steps wrong, and the precautions
// against noise cost a clean mesh nothing.
#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The root mean square distance between two surfaces near a torus, along the torus's normals.
double apart(const Points& X, const Points& Y) {
  const ExactTorus torus(Vec3::Zero(), 1, 0.4);
  double squares = 0;
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    squares += std::pow(torus.signed_distance(X.row(v)) - torus.signed_distance(Y.row(v)), 2);
  }
  return std::sqrt(squares / static_cast<double>(X.rows()));
}

class NoiseInTime : public testing::TestWithParam<double> {};

// A long first step would take the force of the noise on the shape for a force that lasts: at a
// cut-off of 16 and noise of 0.2, the torus would come out wrong by half an edge.
TEST_P(NoiseInTime, FewStepsGoWhereManyGo) {
  State state(make_shape("torus", {.ratio = 2.5, .rows = 40, .columns = 100}));
  const double edge = mean_edge_length(state.X, state.topology.E);
  state.X = shaken(state, GetParam());
  for (const double cutoff : {8, 12, 16}) {
    FlowOptions options;
    const FlowRun few = run_flow(state, cutoff, options);
    options.steps *= 8;
    const FlowRun many = run_flow(state, cutoff, options);
    EXPECT_EQ(few.report.status, FlowStatus::completed);
    EXPECT_LE(few.report.steps.size(), 16U + 8U) << cutoff;
    EXPECT_LT(apart(few.X, many.X), 0.08 * edge) << cutoff;
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, NoiseInTime, testing::Values(0.02, 0.1, 0.2));

TEST(TimeSteps, AreAsManyAsAskedForWithoutNoise) {
  for (const char* shape : {"torus", "cylinder", "catenoid"}) {
    const State state(make_shape(shape, {}));
    FlowOptions options;
    options.solver = "multifrontal";
    const FlowRun run = run_flow(state, 8, options);
    EXPECT_EQ(run.report.steps.size(), 16U) << shape;
    EXPECT_EQ(run.report.factorizations, 1) << shape;
  }
}

}  // namespace
}  // namespace ibmfair::test
