// What rims get back after a flow.
#include "ibmfair/flow/passes/restored_rims.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/passes/rim_fairing.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/select.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

class RestoredRims : public testing::Test {
 protected:
  double edge() const { return mean_edge_length(state_.X, state_.topology.E); }

  /// The noisy cylinder of a seed, for noise in mean edge lengths.
  Points noisy(double noise, int seed) const {
    Points X = state_.X;
    add_noise(X, noise * edge(), seed);
    return X;
  }

  /// The cylinder, moved inward by `depth` edges at its rims, times a function of the direction.
  template <class Share>
  Points shrunk_at_rims(double depth, const Share& share) const {
    Points X = state_.X;
    const double length = depth * edge();
    for (Index v = 0; v < X.rows(); ++v) {
      if (state_.topology.kind[v] == VertexKind::boundary) {
        const double direction = std::atan2(X(v, 1), X(v, 0));
        X.row(v).head<2>() *= 1 - length * share(direction);
      }
    }
    return X;
  }

  Points restored(const Points& start, Points X, double noise) const {
    restore_rims(start, state_.topology, fixed_, 8 * edge(), noise * edge(), X);
    return X;
  }

  /// The root mean square of the distances of the rims from the cylinder, in edges.
  double off_at_rims(const Points& X) const {
    double sum = 0, count = 0;
    for (Index v = 0; v < X.rows(); ++v) {
      if (state_.topology.kind[v] == VertexKind::boundary) {
        sum += std::pow(X.row(v).head<2>().norm() - 1, 2);
        ++count;
      }
    }
    return std::sqrt(sum / count) / edge();
  }

  State state_ = State(make_shape("cylinder", {.rows = 20, .columns = 60}));
  std::vector<std::uint8_t> fixed_ = std::vector<std::uint8_t>(state_.X.rows(), 0);
};

TEST_F(RestoredRims, GetBackWhatLastsAlongThem) {
  for (const double noise : {0.05, 0.2}) {
    const Points constant = shrunk_at_rims(2 * noise, [](double) { return 1; });
    const Points waves =
        shrunk_at_rims(2 * noise, [](double direction) { return std::cos(2 * direction); });
    for (const Points& X : {constant, waves}) {
      for (const int seed : {1, 2, 3}) {
        EXPECT_LT(off_at_rims(restored(noisy(noise, seed), X, noise)), off_at_rims(X) / 2.5)
            << noise << " " << seed;
      }
    }
  }
}

TEST_F(RestoredRims, OfAnyLengthGetAConstantBack) {
  for (const Index columns : {8, 1000, 20'000}) {
    state_ = State(make_shape("cylinder", {.rows = 2, .columns = columns}));
    fixed_.assign(static_cast<std::size_t>(state_.X.rows()), 0);
    const Points X = shrunk_at_rims(0.5, [](double) { return 1; });
    EXPECT_LT(off_at_rims(restored(noisy(0.1, 1), X, 0.1)), 0.12) << columns;
  }
}

/// If nothing else is missing, what comes back is far less than the noise.
TEST_F(RestoredRims, HardlyGetNoiseBack) {
  double sum = 0;
  int untouched = 0;
  constexpr int seeds = 20;
  for (int seed = 0; seed < seeds; ++seed) {
    const double off = off_at_rims(restored(noisy(0.2, seed), state_.X, 0.2));
    sum += off * off;
    untouched += off < 1e-12;
  }
  EXPECT_LT(std::sqrt(sum / seeds), 0.2 / 10);
  EXPECT_GE(untouched, seeds / 2);
}

/// The half of a sphere of radius 1 around the origin, with a jagged rim in one piece.
State half_sphere() {
  const State sphere(make_shape("icosphere", {.subdivide = 4}));
  std::vector<Index> kept;
  for (Index t = 0; t < sphere.topology.F.rows(); ++t) {
    if (sphere.X(sphere.topology.F.row(t), Eigen::all)
            .colwise()
            .sum()
            .dot(Eigen::RowVector3d(3, 8, 5)) > 0) {
      kept.push_back(t);
    }
  }
  return State(mesh_from_triangles(sphere.X, sphere.topology.F(kept, Eigen::all)));
}

TEST(RestoredRimsOfASphere, AreNearerToItAfterAFlow) {
  const State state = half_sphere();
  const double edge = mean_edge_length(state.X, state.topology.E), noise = 0.2, cutoff = 8;
  const auto fixed = fixed_vertices(state.topology, BoundaryCondition::free);  // not part of it
  std::vector<std::uint8_t> near(fixed.size(), 0);
  EXPECT_EQ(state.topology.boundary_loops.size(), 1u);
  for (const Index v : state.topology.boundary_loops.at(0).vertices) {
    near[v] = 1;
  }
  near = grow_one_ring(state.topology, near);
  const std::vector<Index> rings =
      indices_where(state.X.rows(), [&](Index v) { return near[v] != 0; });
  const auto off = [&](const Points& X) {
    return std::sqrt((X(rings, Eigen::all).rowwise().norm().array() - 1).square().mean()) / edge;
  };
  Points start = state.X;
  add_noise(start, noise * edge, 5);
  for (const std::string laplacian : {"umbrella", "crouzeix-raviart", "lagrange"}) {
    Points X = start;
    FlowOptions options;
    options.laplacian = laplacian;
    options.total_time =
        time_in_flow_units(time_for_cutoff(cutoff * edge), X, state.topology, options);
    const auto held =
        fair_rims(X, state.topology, fixed, {.cutoff = cutoff * edge, .noise = noise * edge});
    willmore_flow(X, state.topology, laplacian == "umbrella" ? held : fixed, options);
    const double before = off(X);
    restore_rims(start, state.topology, fixed, cutoff * edge, noise * edge, X);
    EXPECT_LT(off(X), 0.7 * before) << laplacian;
  }
}

TEST_F(RestoredRims, FixedVerticesAndAllBeyondTheCutoffStay) {
  const Points start = noisy(0.05, 1);
  Points X = 0.9 * state_.X;  // all of it is off
  fixed_[state_.topology.boundary_loops[0].vertices[3]] = 1;
  const Points after = restored(start, X, 0.05);
  int moved = 0, stayed = 0;
  for (Index v = 0; v < X.rows(); ++v) {
    const bool moves = after.row(v) != X.row(v);
    const double rings = (1 - std::abs(state_.X(v, 2))) / (2.0 / 20);
    EXPECT_TRUE(!moves || (fixed_[v] == 0 && rings < 8.5)) << v;
    moved += moves;
    stayed += !moves;
  }
  EXPECT_GT(moved, 60 * 4);
  EXPECT_GT(stayed, 60);
}

TEST_F(RestoredRims, TurnAndScaleWithTheMesh) {
  const Points start = noisy(0.1, 3), X = shrunk_at_rims(0.5, [](double) { return 1; });
  const auto moved_points = [&](const Points& Y, double scale) {
    return moved(mesh_from_triangles(Y, state_.topology.F), scale, Vec3::Zero()).X;
  };
  for (const double scale : {1e-8, 1e8}) {
    Points other = moved_points(X, scale);
    restore_rims(moved_points(start, scale), state_.topology, fixed_, 8 * edge() * scale,
                 0.1 * edge() * scale, other);
    EXPECT_LT((other - moved_points(restored(start, X, 0.1), scale)).norm(), 1e-9 * scale);
  }
}

TEST(RestoredRimsOfAnyMesh, AreFinite) {
  for (const NamedMesh& mesh : all_meshes()) {
    const State state(mesh.mesh);
    const std::vector<std::uint8_t> fixed(static_cast<std::size_t>(state.X.rows()), 0);
    Points X = 0.9 * state.X;
    restore_rims(state.X, state.topology, fixed, 3, 0.01, X);
    EXPECT_TRUE(X.allFinite()) << mesh.name;
    if (state.topology.boundary_loops.empty()) {
      EXPECT_EQ(X, 0.9 * state.X) << mesh.name;
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
