// Trials of linear flows by polynomials and by linear systems: they give what the flow gives.
#include "ibmfair/flow/settings/linear_smoother.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/settings/flow_smoother.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double noise = 0.1;  // mean edge lengths

double rms(const Points& moves) {
  return std::sqrt(moves.squaredNorm() / static_cast<double>(moves.rows()));
}

/// Closed, open, and with triangles of all sizes.
std::vector<State> noisy_states() {
  std::vector<State> states{State(make_shape("torus", {.ratio = 2.5, .rows = 32})),
                            State(make_shape("plane", {.rows = 30})),
                            State(make_shape("icosphere", {.subdivide = 3, .refine_face = 2}))};
  for (State& state : states) {
    add_noise(state.X, noise * mean_edge_length(state.X, state.topology.E), 3);
  }
  return states;
}

/// With so few steps, a flow does not go on from the last one.
FlowOptions linear_options() {
  return {.laplacian = "umbrella", .steps = 4, .relax = false, .twicing = 1};
}

TEST(LinearSmoother, GivesWhatTheFlowGives) {
  for (const State& state : noisy_states()) {
    const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
    const TrialMesh mesh(state.X, state.topology, fixed, linear_options(), {50'000, 0});
    const Unknowns unknowns(mesh.fixed());
    FlowSmoother flow(mesh, unknowns);
    LinearSmoother linear(mesh, unknowns);
    Points white = Points::Zero(unknowns.size(), 3);
    add_noise(white, 1, 7);
    const double edge = mesh.mean_edge_length();
    for (const double cutoff : {2.0, 4.0, 8.0, 16.0}) {
      EXPECT_LT(rms(linear.smooth(cutoff * edge) - flow.smooth(cutoff * edge)), 0.15 * noise * edge)
          << cutoff;
      EXPECT_LT(rms(linear.taken_of(white) - flow.taken_of(white)), 0.01 * rms(white)) << cutoff;
    }
  }
}

TEST(LinearSmoother, LeavesFixedVerticesInPlace) {
  const State plane(make_shape("plane", {.rows = 20}));
  const auto fixed = fixed_vertices(plane.topology, BoundaryCondition::fixed);
  const TrialMesh mesh(plane.X, plane.topology, fixed, linear_options(), {50'000, 0});
  const Unknowns unknowns(mesh.fixed());
  const Points X = LinearSmoother(mesh, unknowns).smooth(4 * mesh.mean_edge_length());
  for (Index v = 0; v < X.rows(); ++v) {
    EXPECT_TRUE(!fixed[v] || X.row(v) == plane.X.row(v));
  }
}

TEST(LinearSmoother, IsForFlowsWithoutRelaxationAndAreas) {
  EXPECT_TRUE(is_linear(linear_options()));
  EXPECT_FALSE(is_linear({.laplacian = "umbrella"}));
  EXPECT_FALSE(is_linear({.laplacian = "lagrange", .relax = false}));
  EXPECT_FALSE(is_linear({.laplacian = "umbrella", .mass_matrix = "barycentric", .relax = false}));
  EXPECT_FALSE(is_linear({.laplacian = "umbrella", .relax = false, .max_move = 1}));
}

}  // namespace
}  // namespace ibmfair::test
