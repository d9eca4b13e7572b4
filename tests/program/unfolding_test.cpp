// Foldovers that noise left upside down are unfolded, and no other vertices are moved.
#include "ibmfair/flow/passes/unfolding.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/shapes/shapes.h"
#include "support/program_figures.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"
#include "support/thin_states.h"

namespace ibmfair::test {
namespace {

constexpr double flat = 0.6;

/// The moves of the vertices when the flagged vertices are fixed.
Points unfolded_by(const State& state, const std::vector<std::uint8_t>& fixed) {
  const CompressedRows rings = vertex_rings(state.topology);
  Points X = state.X;
  const FlowOptions options;
  const FlowProblem problem(state.X, state.topology, fixed, options, MeshParts::one());
  for (const VertexPatch& patch : find_folded_patches(problem, rings, flat)) {
    even_out(patch, rings, X);
  }
  return X - state.X;
}

std::vector<std::uint8_t> none_of(const State& state) {
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(state.X.rows()), 0);
  return flags;
}

std::int64_t folds_in(const Points& X, const Topology& topology) {
  const auto folded = folded_hinges(X, topology, std::numbers::pi / 3);
  return std::count(folded.begin(), folded.end(), 1);
}

/// Smooth surfaces with triangles so small that a few neighbouring triangles are nearly flat.
std::vector<State> smooth_states() {
  return {State(make_shape("icosphere", {.subdivide = 4})),
          State(make_shape("torus", {.rows = 48, .columns = 120})),
          State(make_shape("plane", {.rows = 25, .columns = 40}))};
}

/// Interior vertices whose rings are two or more rings away from each other and from any boundary.
std::vector<Index> far_apart(const Topology& topology) {
  const CompressedRows rings = vertex_rings(topology);
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(topology.vertex_count), 0);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    taken[v] = topology.kind[v] == VertexKind::interior ? 0 : 1;
  }
  for (int i = 0; i < 3; ++i) {
    taken = grow_one_ring(topology, taken);
  }
  std::vector<Index> chosen;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (taken[v] == 0) {
      chosen.push_back(v);
      std::vector<std::uint8_t> around(taken.size(), 0);
      around[v] = 1;
      for (int i = 0; i < 7; ++i) {
        around = grow_one_ring(topology, around);
      }
      std::transform(taken.begin(), taken.end(), around.begin(), taken.begin(),
                     [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    }
  }
  return chosen;
}

/// Each of these vertices changes places with its first neighbour, so that the two triangles at the
/// edge between them are upside down.
Points with_flaps(const State& state, const std::vector<Index>& vertices) {
  const CompressedRows rings = vertex_rings(state.topology);
  Points X = state.X;
  for (const Index v : vertices) {
    X.row(v).swap(X.row(rings[v][0]));
  }
  return X;
}

TEST(Unfolding, UnfoldsFlapsOnSmoothSurfacesAndMovesNothingElse) {
  for (State state : smooth_states()) {
    const double edge = mean_edge_length(state.X, state.topology.E);
    const Points smooth = state.X;
    const std::vector<Index> vertices = far_apart(state.topology);
    ASSERT_GE(vertices.size(), 5U);
    state.X = with_flaps(state, vertices);
    ASSERT_GT(folds_in(state.X, state.topology), 0);
    const Points move = unfolded_by(state, none_of(state));
    const Points X = state.X + move;
    EXPECT_EQ(folds_in(X, state.topology), 0);
    EXPECT_LT((X - smooth).rowwise().norm().maxCoeff(), edge);

    const std::vector<std::uint8_t> near = around(state.topology, vertices, 3);
    for (Index v = 0; v < X.rows(); ++v) {
      EXPECT_TRUE(near[v] != 0 || X.row(v) == state.X.row(v)) << v;
    }
  }
}

TEST(Unfolding, KeepsWhatIsHeldAndPatchesToThemselves) {
  for (State state : smooth_states()) {
    const std::vector<Index> vertices = far_apart(state.topology);
    state.X = with_flaps(state, vertices);
    const Points all = unfolded_by(state, none_of(state));
    const std::vector<std::uint8_t> fixed = around(state.topology, {vertices[0]}, 2);
    const Points rest = unfolded_by(state, fixed);
    for (Index v = 0; v < all.rows(); ++v) {
      if (fixed[v] != 0) {
        EXPECT_EQ(rest.row(v), Vec3(Vec3::Zero()).transpose()) << v;
      }
    }
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      EXPECT_EQ(rest.row(vertices[i]), all.row(vertices[i])) << i;
    }
  }
}

TEST(Unfolding, LeavesSmoothThinAndSharpSurfacesAlone) {
  for (const State& state : smooth_states()) {
    EXPECT_TRUE(unfolded_by(state, none_of(state)).isZero(0));
  }
  for (const double angle : {2.0, 5.0, 20.0, 40.0, 55.0}) {
    const State sharp = wedge(angle * degree), tip = needle(angle * degree);
    EXPECT_GT(folds_in(sharp.X, sharp.topology), 0) << angle;
    EXPECT_TRUE(unfolded_by(sharp, none_of(sharp)).isZero(0)) << angle;
    EXPECT_TRUE(unfolded_by(tip, none_of(tip)).isZero(0)) << angle;
  }
}

TEST(Unfolding, LeavesNoFlapOnASphereThatNoiseTurnedInsideOut) {
  const TemporaryDirectory directory;
  const std::string noisy = directory / "noisy.off", out = directory / "out.off";
  ASSERT_EQ(
      run_program({"make", "icosphere", noisy, "--subdivide", "3", "--noise", "0.6", "--seed", "4"})
          .exit_code,
      0);
  const auto report = figures({"smooth", noisy, out, "--cutoff", "8", "--quiet"});
  EXPECT_GT(report["flow"]["unfolded_vertices"], 0);
  EXPECT_EQ(report["steps"].back()["energy"], report["flow"]["energy_after"]);
  const auto found = figures({"compare", out, "--sphere", "1"});
  EXPECT_EQ(found["exact_surface"]["triangle_normal_degrees"]["flipped"], 0);
}

}  // namespace
}  // namespace ibmfair::test
