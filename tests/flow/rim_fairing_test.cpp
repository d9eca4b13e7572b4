// Open boundaries that are faired along themselves.
#include "ibmfair/flow/passes/rim_fairing.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/passes/rim_runs.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::vector<std::uint8_t> nothing_fixed(const State& state) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(state.X.rows()), 0);
}

double edge_at_rim(const State& state) {
  return mean_edge_length(state.X, state.topology.E);
}

Points faired(const State& state, double cutoff, double noise) {
  Points X = state.X;
  fair_rims(X, state.topology, nothing_fixed(state),
            {.cutoff = cutoff * edge_at_rim(state), .noise = noise * edge_at_rim(state)});
  return X;
}

/// The root mean square over the rims of what a function of the position says.
template <class Error>
double rms_at_rims(const State& state, const Points& X, const Error& error) {
  double sum = 0, count = 0;
  for (const BoundaryLoop& loop : state.topology.boundary_loops) {
    for (const Index v : loop.vertices) {
      sum += std::pow(error(Vec3(X.row(v))), 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

/// The root mean square of the second differences along the rims, in mean edge lengths.
double jaggedness(const State& state, const Points& X) {
  double sum = 0, count = 0;
  for (const BoundaryLoop& loop : state.topology.boundary_loops) {
    const auto& v = loop.vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Index before = v[(i + v.size() - 1) % v.size()], after = v[(i + 1) % v.size()];
      sum += (X.row(before) - 2 * X.row(v[i]) + X.row(after)).squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / count) / edge_at_rim(state);
}

State cylinder() {
  return State(make_shape("cylinder", {.rows = 20, .columns = 60}));
}

/// The distance of a place from the rims of the cylinder.
double off_circles(const Vec3& x) {
  return std::hypot(std::hypot(x.x(), x.y()) - 1, std::abs(x.z()) - 1);
}

TEST(RimRuns, CornersOfASquareAreFoundUnderNoise) {
  for (const double noise : {0.0, 0.2, 0.4}) {
    State state(flat_sheet(40, 40));
    const Points clean = state.X;
    add_noise(state.X, noise * edge_at_rim(state), 7);
    const auto runs = rim_runs(state.X, state.topology, nothing_fixed(state));
    ASSERT_EQ(runs.size(), 4u) << noise;
    for (const RimRun& run : runs) {
      EXPECT_FALSE(run.closed);
      EXPECT_NEAR(static_cast<double>(run.vertices.size()), 41, noise > 0 ? 3 : 0);
      for (const Index end : {run.vertices.front(), run.vertices.back()}) {
        const double away = (clean.row(end).head<2>().array() - 0.5).abs().minCoeff();
        EXPECT_GT(away, 0.5 - 2.5 / 40) << noise;
      }
    }
  }
}

TEST(RimRuns, RoundRimsHaveNoCorners) {
  for (const double noise : {0.0, 0.3}) {
    for (const Index columns : {8, 12, 24, 60, 200}) {
      State state(make_shape("cylinder", {.rows = 4, .columns = columns}));
      add_noise(state.X, noise * 2 * std::sin(std::numbers::pi / columns), 3);
      for (const RimRun& run : rim_runs(state.X, state.topology, nothing_fixed(state))) {
        EXPECT_TRUE(run.closed) << columns << " " << noise;
      }
    }
  }
}

TEST(RimRuns, EndAtFixedVertices) {
  const State state = cylinder();
  auto fixed = nothing_fixed(state);
  const std::vector<Index> loop = state.topology.boundary_loops.at(0).vertices;
  fixed[loop[5]] = fixed[loop[30]] = 1;
  const auto runs = rim_runs(state.X, state.topology, fixed);
  ASSERT_EQ(runs.size(), 3u);  // two of this loop, and the other loop
  EXPECT_EQ(runs[0].vertices.front(), loop[5]);
  EXPECT_EQ(runs[0].vertices.back(), loop[30]);
  EXPECT_EQ(runs[1].vertices.back(), loop[5]);
  Points X = state.X;
  add_noise(X, 0.1, 1);
  const Points noisy = X;
  fair_rims(X, state.topology, fixed, {.cutoff = 1});
  EXPECT_EQ(X.row(loop[5]), noisy.row(loop[5]));
  EXPECT_NE(X.row(loop[6]), noisy.row(loop[6]));
}

/// A rim that meets itself: two corners of a sheet, far apart along its rim, are one vertex. Such
/// vertices are fixed in every flow.
TEST(RimRuns, EndWhereARimMeetsItself) {
  const State sheet(flat_sheet(20, 20));
  const std::vector<Index> rim = sheet.topology.boundary_loops.at(0).vertices;
  Triangles F = sheet.topology.F;
  for (Index& v : F.reshaped()) {
    v = v == rim[40] ? rim[0] : v;
  }
  const State state(mesh_from_triangles(sheet.X, F));
  const auto fixed = fixed_vertices(state.topology, BoundaryCondition::free);
  ASSERT_EQ(fixed[rim[0]], 1);
  std::size_t inner = 0;
  for (const RimRun& run : rim_runs(state.X, state.topology, fixed)) {
    inner += run.vertices.size() - 2;
  }
  EXPECT_GT(inner, 70u);  // of 80 vertices, without corners
}

TEST(RimFairing, RemovesNoiseAndKeepsCircles) {
  State state = cylinder();
  EXPECT_LT(rms_at_rims(state, faired(state, 8, 0), off_circles), 1e-3 * edge_at_rim(state));
  const double was = jaggedness(state, state.X);
  add_noise(state.X, 0.2 * edge_at_rim(state), 3);
  const double noisy = jaggedness(state, state.X) - was;
  for (const double told : {0.0, 0.2}) {
    const Points X = faired(state, 10, told);
    EXPECT_LT(jaggedness(state, X) - was, noisy / 5) << told;
    EXPECT_LT(rms_at_rims(state, X, off_circles), 0.55 * rms_at_rims(state, state.X, off_circles));
  }
}

TEST(RimFairing, MovesOnlyRims) {
  State state = cylinder();
  add_noise(state.X, 0.2 * edge_at_rim(state), 3);
  const Points X = faired(state, 8, 0.2);
  for (Index v = 0; v < state.X.rows(); ++v) {
    if (state.topology.kind[v] != VertexKind::boundary) {
      EXPECT_EQ(X.row(v), state.X.row(v));
    }
  }
}

/// Heights over a square: the outline is exact, and stays straight with its corners in place.
TEST(RimFairing, StraightOutlinesOfNoisyHeightsStay) {
  State state(flat_sheet(30, 30));
  RandomNumbers random(1);
  for (double& z : state.X.col(2)) {
    z = 0.3 * edge_at_rim(state) * random.normal();
  }
  for (const double told : {0.0, 0.3}) {
    const Points X = faired(state, 8, told);
    double moved = 0;
    for (Index v = 0; v < state.X.rows(); ++v) {
      for (int axis = 0; axis < 2; ++axis) {
        const double before = state.X(v, axis);
        if (state.topology.kind[v] == VertexKind::boundary && (before == 0 || before == 1)) {
          EXPECT_NEAR(X(v, axis), before, 1e-12) << told;
        }
      }
      moved = std::max(moved, std::abs(X(v, 2) - state.X(v, 2)));
    }
    EXPECT_GT(moved, 0.2 * edge_at_rim(state));
  }
}

/// A zigzag of the triangles that is larger than the noise is not noise.
TEST(RimFairing, AnOutlineThatIsMoreJaggedThanTheNoiseStaysForTheMostPart) {
  State state = cylinder();
  for (const BoundaryLoop& loop : state.topology.boundary_loops) {
    for (std::size_t i = 0; i < loop.vertices.size(); i += 2) {
      state.X(loop.vertices[i], 2) *= 1 - 0.5 * edge_at_rim(state);
    }
  }
  const double before = jaggedness(state, state.X);
  EXPECT_GT(jaggedness(state, faired(state, 8, 0.05)), 0.9 * before);
  EXPECT_LT(jaggedness(state, faired(state, 8, 0)), 0.2 * before);
}

TEST(RimFairing, KeepsTheBoundOnMovesAndFoldsNothing) {
  State state = cylinder();
  add_noise(state.X, 0.5 * edge_at_rim(state), 3);
  const double most = 0.05 * edge_at_rim(state);
  Points X = state.X;
  fair_rims(X, state.topology, nothing_fixed(state),
            {.cutoff = 8 * edge_at_rim(state), .max_move = most});
  EXPECT_LE((X - state.X).rowwise().norm().maxCoeff(), most * (1 + 1e-12));
  EXPECT_GT((X - state.X).rowwise().norm().maxCoeff(), 0.9 * most);
}

TEST(RimFairing, TurnsAndScalesWithTheMesh) {
  State state = cylinder();
  add_noise(state.X, 0.2 * edge_at_rim(state), 3);
  const Mesh mesh = mesh_from_triangles(state.X, state.topology.F);
  for (const double scale : {1e-8, 1e8}) {
    const State other(moved(mesh, scale, Vec3::Zero()));
    const Points expected =
        moved(mesh_from_triangles(faired(state, 8, 0.2), state.topology.F), scale, Vec3::Zero()).X;
    EXPECT_LT((faired(other, 8, 0.2) - expected).norm(), 1e-9 * scale);
  }
}

TEST(RimFairing, MovesVanishWithTheCutoff) {
  State state = cylinder();
  add_noise(state.X, 0.3 * edge_at_rim(state), 3);
  for (const double cutoff : {0.01, 0.1, 0.5}) {
    EXPECT_LE((faired(state, cutoff, 0) - state.X).rowwise().norm().maxCoeff(),
              cutoff * cutoff * edge_at_rim(state))
        << cutoff;
  }
}

TEST(RimFairing, MeshesWithoutRoomForACurveStay) {
  for (const NamedMesh& mesh : all_meshes()) {
    const State state(mesh.mesh);
    const Points X = faired(state, 8, 0);
    EXPECT_TRUE(X.allFinite()) << mesh.name;
    if (state.topology.boundary_loops.empty()) {
      EXPECT_EQ(X, state.X) << mesh.name;
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
