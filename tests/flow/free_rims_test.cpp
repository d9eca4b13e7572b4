// Open boundaries that the flow may move: they move along the surface's normals, and no spikes
// grow.
#include "ibmfair/flow/steps/free_rims.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/family.h"
#include "support/flow_run.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr auto free_boundary = BoundaryCondition::free;

/// What is left of a mesh if the triangles are taken away whose centre the function names.
template <class IsCut>
State cut(const Mesh& mesh, const IsCut& is_cut) {
  const State whole(mesh);
  std::vector<Index> kept;
  for (Index t = 0; t < whole.topology.F.rows(); ++t) {
    const auto corners = whole.topology.F.row(t);
    const Vec3 centre =
        (whole.X.row(corners[0]) + whole.X.row(corners[1]) + whole.X.row(corners[2])) / 3;
    if (!is_cut(centre)) {
      kept.push_back(t);
    }
  }
  return State(mesh_from_triangles(whole.X, Triangles(whole.topology.F(kept, Eigen::all))));
}

State holed_ball() {
  return cut(make_shape("icosphere", {.subdivide = 3}), [](const Vec3& x) { return x.z() > 0.6; });
}

State holed_torus() {
  return cut(make_shape("torus", {.ratio = 2.5, .rows = 20}),
             [](const Vec3& x) { return x.x() > 0.9; });
}

/// A flat sheet with a jagged outline and a jagged hole.
State jagged_sheet() {
  return cut(flat_sheet(20, 20), [](const Vec3& x) {
    return std::sin(37 * x.x()) + std::cos(29 * x.y()) > 1.6 ||
           (x - Vec3(0.5, 0.5, 0)).norm() < 0.1;
  });
}

double edge_around(const State& state) {
  return mean_edge_length(state.X, state.topology.E);
}

void add_noise_of(State& state, double edges) {
  add_noise(state.X, edges * edge_around(state), 5);
}

double longest_move(const State& state, const FlowRun& run) {
  return (run.X - state.X).rowwise().norm().maxCoeff();
}

bool is_rim(const State& state, Index v) {
  return state.topology.kind[v] == VertexKind::boundary;
}

TEST(FreeRims, TheOutlineOfAFlatSheetStays) {
  for (const Member& member : family()) {
    SCOPED_TRACE(identifier(member));
    const State state = jagged_sheet();
    const FlowRun run = run_flow(
        state, 8, {.laplacian = member.laplacian, .mass_matrix = member.mass}, free_boundary);
    EXPECT_LT((run.X.col(2) - state.X.col(2)).norm(), 1e-9);
    for (Index v = 0; v < state.X.rows(); ++v) {
      if (is_rim(state, v)) {
        EXPECT_LT((run.X.row(v) - state.X.row(v)).norm(), 1e-9 * edge_around(state)) << v;
      }
    }
  }
}

TEST(FreeRims, GrowNoSpikesAndRaiseNoEnergy) {
  for (State state : {holed_ball(), holed_torus(), State(make_shape("catenoid", {.rows = 12}))}) {
    add_noise_of(state, 0.3);
    for (const Member& member : family()) {
      for (const double cutoff : {4.0, 8.0}) {
        SCOPED_TRACE(identifier(member) + " " + std::to_string(cutoff));
        const FlowOptions options{.laplacian = member.laplacian, .mass_matrix = member.mass};
        const FlowRun free = run_flow(state, cutoff, options, free_boundary);
        EXPECT_LE(longest_move(state, free),
                  1.5 * longest_move(state, run_flow(state, cutoff, options)));
        double last = free.report.energy_before;
        for (const StepRecord& step : free.report.steps) {
          EXPECT_LE(step.energy, last * (1 + 1e-12));
          last = step.energy;
        }
      }
    }
  }
}

/// Slivers at a rim are where spikes grew: a step along the normal, however short, lengthens them.
TEST(FreeRims, SliversDoNotGrowIntoSpikes) {
  State state = holed_ball();
  const std::vector<Index> rim = state.topology.boundary_loops.at(0).vertices;
  for (std::size_t i = 0; i < rim.size(); i += 3) {
    Index inner = -1;
    for (const Index t : state.topology.stars[rim[i]]) {
      for (const Index v : state.topology.F.row(t)) {
        inner = is_rim(state, v) ? inner : v;
      }
    }
    if (inner >= 0) {
      state.X.row(rim[i]) = 0.05 * state.X.row(rim[i]) + 0.95 * state.X.row(inner);
    }
  }
  add_noise_of(state, 0.05);
  for (const double sharp_angle : {0.0, 0.5}) {
    for (const double cutoff : {4.0, 8.0}) {
      const FlowOptions options{.sharp_angle = sharp_angle};
      const FlowRun run = run_flow(state, cutoff, options, free_boundary);
      EXPECT_LT(longest_move(state, run), 1.2 * edge_around(state)) << sharp_angle << " " << cutoff;
    }
  }
}

TEST(FreeRims, MovesVanishWithTheCutoff) {
  for (const NamedMesh& mesh : open_meshes()) {
    SCOPED_TRACE(mesh.name);
    State state(mesh.mesh);
    add_noise_of(state, 0.3);
    for (const char* laplacian : {"crouzeix-raviart", "lagrange", "umbrella"}) {
      for (const double cutoff : {0.01, 0.1, 0.5}) {
        const FlowRun run = run_flow(state, cutoff, {.laplacian = laplacian}, free_boundary);
        EXPECT_LE(longest_move(state, run), 3 * cutoff * cutoff * edge_around(state))
            << laplacian << " " << cutoff;
      }
    }
  }
}

TEST(FreeRims, TurnAndScaleWithTheMesh) {
  State state = holed_ball();
  add_noise_of(state, 0.2);
  const Mesh mesh = mesh_from_triangles(state.X, state.topology.F);
  for (const double scale : {1e-6, 1e6}) {
    const State other(moved(mesh, scale, Vec3::Zero()));
    const Points expected =
        moved(mesh_from_triangles(run_flow(state, 6, {}, free_boundary).X, state.topology.F), scale,
              Vec3::Zero())
            .X;
    const Points found = run_flow(other, 6, {}, free_boundary).X;
    EXPECT_LT((found - expected).rowwise().norm().maxCoeff(), 1e-6 * scale) << scale;
  }
}

TEST(FreeRims, NormalsNeedNoOrientation) {
  for (const NamedMesh& named : nonorientable_meshes()) {
    State state(named.mesh);
    const std::vector<std::uint8_t> none(static_cast<std::size_t>(state.X.rows()), 0);
    const Unknowns unknowns(none);
    FreeRims rims(state.X, state.topology, unknowns);
    if (rims.empty()) {
      continue;
    }
    rims.find_normals(state.X);
    Points rows = random_directions(state.X.rows());
    const Points before = rows;
    rims.project(rows);
    for (Index v = 0; v < state.X.rows(); ++v) {
      const double ratio = rows.row(v).norm() / before.row(v).norm();
      EXPECT_TRUE(is_rim(state, v) ? ratio < 1 : ratio == 1) << named.name << " " << v;
    }
    Points again = rows;
    rims.project(again);
    EXPECT_LT((again - rows).norm(), 1e-12) << named.name;
  }
}

}  // namespace
}  // namespace ibmfair::test
