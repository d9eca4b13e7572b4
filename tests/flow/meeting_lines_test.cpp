// Lines at which sheets meet: how they are found, and how they are faired.
#include "ibmfair/flow/passes/meeting_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/geometry.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Three square sheets of n x n cells that meet along the z axis.
Mesh three_sheets(Index n) {
  Mesh mesh;
  mesh.X.resize((3 * n + 1) * (n + 1), 3);
  const auto at = [&](int sheet, Index i, Index j) {
    return i == 0 ? j : (n + 1) * (1 + sheet * n + i - 1) + j;
  };
  for (int sheet = 0; sheet < 3; ++sheet) {
    const double angle = 2 * std::acos(-1.0) * sheet / 3;
    for (Index i = 0; i <= n; ++i) {
      for (Index j = 0; j <= n; ++j) {
        mesh.X.row(at(sheet, i, j)) << i * std::cos(angle), i * std::sin(angle), j;
      }
    }
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        mesh.faces.add(std::array{at(sheet, i, j), at(sheet, i + 1, j), at(sheet, i + 1, j + 1)});
        mesh.faces.add(std::array{at(sheet, i, j), at(sheet, i + 1, j + 1), at(sheet, i, j + 1)});
      }
    }
  }
  return mesh;
}

/// Each face of the mesh twice.
Mesh make_double(Mesh mesh) {
  const Index count = mesh.faces.size();
  for (Index f = 0; f < count; ++f) {
    const std::array<Index, 3> corners{mesh.faces[f][0], mesh.faces[f][1], mesh.faces[f][2]};
    mesh.faces.add(corners);
  }
  return mesh;
}

TEST(MeetingLines, AreOneCircleForTwoHalfBalls) {
  for (const Index radius : {5, 7, 8, 12}) {
    const State state(two_half_balls(radius));
    const auto lines = find_meeting_lines(state.topology);
    ASSERT_EQ(lines.size(), 1);
    EXPECT_TRUE(lines[0].closed);
    EXPECT_EQ(std::ssize(lines[0].vertices), std::ssize(state.topology.defects.non_manifold_edges));
  }
}

TEST(MeetingLines, EndAtOpenBoundariesAndAreNotFoundWhereThereAreNone) {
  const State state(three_sheets(6));
  const auto lines = find_meeting_lines(state.topology);
  ASSERT_EQ(lines.size(), 1);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_EQ(lines[0].vertices.size(), 7);
  for (const NamedMesh& mesh : good_meshes()) {
    EXPECT_TRUE(find_meeting_lines(State(mesh.mesh).topology).empty()) << mesh.name;
  }
  // Triangles that lie over each other have edges of four triangles, but no sheets that meet.
  const Mesh twice = make_double(in_triangles(flat_sheet(6, 6)));
  EXPECT_TRUE(find_meeting_lines(State(twice).topology).empty());
}

TEST(MeetingLines, StayIfTheyAreStraight) {
  const State state(three_sheets(12));
  Points X = state.X;
  fair_meeting_lines(find_meeting_lines(state.topology), state.topology, 8, {}, unbounded, X);
  EXPECT_LT((X - state.X).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(MeetingLines, LoseTheirNoiseAndMoveNothingElse) {
  const State state(three_sheets(40));
  const auto lines = find_meeting_lines(state.topology);
  const Points noisy = shaken(state, 0.2);
  Points X = noisy;
  fair_meeting_lines(lines, state.topology, 8, {}, unbounded, X);
  double before = 0, after = 0;
  std::vector<std::uint8_t> on_line(static_cast<std::size_t>(X.rows()), 0);
  for (const Index v : lines[0].vertices) {
    on_line[v] = 1;
    before += noisy.row(v).head<2>().squaredNorm();
    after += X.row(v).head<2>().squaredNorm();
  }
  EXPECT_LT(after, 0.3 * before);
  for (Index v = 0; v < X.rows(); ++v) {
    EXPECT_TRUE(on_line[v] || X.row(v) == noisy.row(v));
  }
}

TEST(MeetingLines, RespectFactorsBoundsAndFolds) {
  const State state(two_half_balls(8));
  const auto lines = find_meeting_lines(state.topology);
  const Index kept = lines[0].vertices[5];
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(state.X.rows());
  factor[kept] = 0;
  Points X = state.X;
  fair_meeting_lines(lines, state.topology, 8, factor, 0.1, X);
  EXPECT_EQ(X.row(kept), state.X.row(kept));
  const double longest = (X - state.X).rowwise().norm().maxCoeff();
  EXPECT_LE(longest, 0.1);
  EXPECT_GT(longest, 0.09);
  for (const double cutoff : {2.0, 8.0, 30.0}) {
    for (const double noise : {0.0, 0.3}) {
      const Points start = shaken(state, noise);
      Points Y = start;
      fair_meeting_lines(lines, state.topology, cutoff, {}, unbounded, Y);
      EXPECT_TRUE(FoldWatch(start, state.topology).new_folds(Y).empty()) << cutoff;
      EXPECT_GT((Y - start).norm(), 0.1);
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
