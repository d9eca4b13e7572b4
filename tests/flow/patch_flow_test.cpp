// A patch of a mesh that flows by itself moves as it would move in a flow of the whole mesh.
#include "ibmfair/flow/passes/patch_flow.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/steps/guarded_flow.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

using Flags = std::vector<std::uint8_t>;

TEST(Patches, AreThePiecesOfWhatIsWantedAndMayMove) {
  const State state(make_shape("plane", {.rows = 25, .columns = 40}));
  const Flags fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
  const FlowOptions options;
  const FlowProblem problem(state.X, state.topology, fixed, options, MeshParts::one());
  const Unknowns& unknowns = problem.unknowns;
  const CompressedRows rings = vertex_rings(state.topology);
  const Flags wanted = around(state.topology, {300, 306, 330, 0}, 2);
  const std::vector<VertexPatch> patches = patches_of(wanted, rings, problem);
  EXPECT_EQ(patches.size(), 3U);
  std::vector<int> patch_of(wanted.size(), -1);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    EXPECT_TRUE(std::ranges::is_sorted(patches[p]));
    for (const Index v : patches[p]) {
      EXPECT_EQ(patch_of[v], -1);
      patch_of[v] = static_cast<int>(p);
    }
  }
  for (Index v = 0; v < unknowns.size(); ++v) {
    EXPECT_EQ(patch_of[v] >= 0, wanted[v] != 0 && unknowns.unknown[v] >= 0) << v;
    for (const Index q : rings[v]) {
      EXPECT_TRUE(patch_of[v] < 0 || patch_of[q] < 0 || patch_of[v] == patch_of[q]);
    }
  }
}

struct Setting {
  std::string name;
  FlowOptions options;
};

std::vector<Setting> settings(const State& state) {
  std::vector<Setting> all{{"Crouzeix-Raviart", {}},
                           {"Lagrange", {.laplacian = "lagrange"}},
                           {"umbrella", {.laplacian = "umbrella"}},
                           {"identity", {.mass = false, .metric = Metric::identity}},
                           {"sharp", {.sharp_angle = 0.5}},
                           {"bounded", {.max_move = 0.05}},
                           {"bent", {.laplacian = "lagrange"}},
                           {"uneven", {}},
                           {"two iterations", {.newton_iterations = 2}}};
  all[6].options.spontaneous_curvature = state.X.col(0);
  all[7].options.cutoff_factor = state.X.col(1).array() + 3;
  return all;
}

TEST(PatchFlow, GoesWhereTheMeshWouldGoWithTheRestHeld) {
  State state(make_shape("torus", {.ratio = 2.5, .rows = 24, .columns = 60}));
  state.X = shaken(state, 0.2);
  const CompressedRows rings = vertex_rings(state.topology);
  const double edge = mean_edge_length(state.X, state.topology.E);
  const Flags wanted = around(state.topology, {700}, 3);
  for (auto& [name, options] : settings(state)) {
    SCOPED_TRACE(name);
    options.solver = "multifrontal";
    options.total_time =
        time_in_flow_units(time_for_cutoff(6 * edge), state.X, state.topology, options);
    FlowProblem problem(state.X, state.topology, Flags(wanted.size(), 0), options,
                        MeshParts::one());
    problem.report.solver = options.solver;
    const VertexPatch patch = patches_of(wanted, rings, problem).front();
    Points move = Points::Zero(state.X.rows(), 3);
    EXPECT_TRUE(PatchFlow(problem, rings).run(patch, state.X, options.total_time, move));

    Flags fixed(wanted.size());
    std::ranges::transform(wanted, fixed.begin(), [](auto flag) { return flag ? 0 : 1; });
    FlowOptions options_alone = options;
    options_alone.clean_up = false;
    FlowProblem alone(state.X, state.topology, fixed, options_alone, MeshParts::one());
    const FoldWatch folds(alone.X, alone.topology);
    run_guarded(alone, rings, folds, {});  // patches come last, after any first stage
    EXPECT_GT(move.norm(), 0.01 * edge);
    EXPECT_LT((state.X + move - alone.X).rowwise().norm().maxCoeff(), 1e-6 * edge);
  }
}

TEST(PatchFlow, LeavesAPatchAloneThatWouldHaveMoreEnergy) {
  const State state(make_shape("icosphere", {.subdivide = 3}));
  const CompressedRows rings = vertex_rings(state.topology);
  FlowOptions options;
  options.total_time = time_for_cutoff(4 * mean_edge_length(state.X, state.topology.E));
  const FlowProblem problem(state.X, state.topology, Flags(state.X.rows(), 0), options,
                            MeshParts::one());
  const Flags wanted = around(state.topology, {100}, 2);
  const VertexPatch patch = patches_of(wanted, rings, problem).front();
  Points move = Points::Zero(state.X.rows(), 3);
  const Points rough = shaken(state, 0.3);
  EXPECT_FALSE(PatchFlow(problem, rings).run(patch, rough, 1e-9 * options.total_time, move));
  EXPECT_TRUE(move.isZero(0));
}

}  // namespace
}  // namespace ibmfair::test
