// Residual spikes are the remains of noise in a flow that keeps creases. The tests check which
// patches count as residual spikes, and that the flow removes them.
#include "ibmfair/flow/passes/residual_spikes.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/angle.h"
#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double sharp_angle = radians(20);

std::vector<VertexPatch> spikes_of(const Points& X, const Topology& topology,
                                   const CompressedRows& rings,
                                   const std::vector<std::uint8_t>& fixed) {
  FlowOptions options;
  options.sharp_angle = sharp_angle;
  return find_residual_spikes(FlowProblem(X, topology, fixed, options, MeshParts::one()), rings);
}

/// A cube with a spike in the middle of a face.
class Spike : public testing::Test {
 protected:
  Spike() {
    (cube_.X.rowwise() - Vec3(0, 0, 1).transpose()).rowwise().norm().minCoeff(&middle_);
    X_.row(middle_) += edge_ * Vec3(0, 0, 0.5).transpose();
  }

  std::vector<VertexPatch> spikes(const Points& X, const std::vector<std::uint8_t>& fixed) const {
    return spikes_of(X, cube_.topology, rings_, fixed);
  }

  FlowOptions keeping_creases(double cutoff_edges) const {
    FlowOptions options;
    options.steps = 8;
    options.sharp_angle = sharp_angle;
    const double time = time_for_cutoff(cutoff_edges * edge_);
    options.total_time = time_in_flow_units(time, cube_.X, cube_.topology, options);
    return options;
  }

  const State cube_{make_shape("cube", {.subdivide = 4})};
  const CompressedRows rings_ = vertex_rings(cube_.topology);
  const double edge_ = mean_edge_length(cube_.X, cube_.topology.E);
  const std::vector<std::uint8_t> free_ =
      std::vector<std::uint8_t>(static_cast<std::size_t>(cube_.topology.vertex_count), 0);
  Index middle_ = 0;
  Points X_ = cube_.X;
};

TEST_F(Spike, IsASpeckAndEdgesAndCornersAreNot) {
  EXPECT_TRUE(spikes(cube_.X, free_).empty());
  const std::vector<VertexPatch> found = spikes(X_, free_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].size(), rings_[middle_].size() + 1);
  EXPECT_TRUE(std::ranges::binary_search(found[0], middle_));
}

TEST_F(Spike, IsLeftWhereItIsHeldInPart) {
  std::vector<std::uint8_t> fixed = free_;
  fixed[rings_[middle_][0]] = 1;
  EXPECT_TRUE(spikes(X_, fixed).empty());
}

TEST_F(Spike, IsLeftAtABoundary) {
  const State plane(make_shape("plane", {}));
  const CompressedRows rings = vertex_rings(plane.topology);
  const double height = 0.5 * mean_edge_length(plane.X, plane.topology.E);
  int inside = 0, at_boundary = 0;
  for (Index v = 0; v < plane.topology.vertex_count; ++v) {
    Points X = plane.X;
    X.row(v) += height * Vec3(0, 0, 1).transpose();
    const auto found = spikes_of(X, plane.topology, rings,
                                 std::vector<std::uint8_t>(plane.topology.vertex_count, 0));
    const bool is_inside = plane.topology.kind[v] == VertexKind::interior &&
                           std::ranges::all_of(rings[v], [&](Index q) {
                             return plane.topology.kind[q] == VertexKind::interior;
                           });
    EXPECT_EQ(found.size(), is_inside ? 1U : 0U) << v;
    (is_inside ? inside : at_boundary) += 1;
  }
  EXPECT_GT(inside, 0);
  EXPECT_GT(at_boundary, 0);
}

TEST_F(Spike, OnAnEdgeIsPartOfIt) {
  Points X = cube_.X;
  Index on_edge = 0;
  (cube_.X.rowwise() - Vec3(0, 1, 1).transpose()).rowwise().norm().minCoeff(&on_edge);
  X.row(on_edge) += edge_ * Vec3(0, 0, 0.5).transpose();
  EXPECT_TRUE(spikes(X, free_).empty());
}

TEST_F(Spike, IsEvenedOutWithNothingElse) {
  const FlowOptions options = keeping_creases(6);
  FlowProblem problem(X_, cube_.topology, free_, options, MeshParts::one());
  flatten_residual_spikes(problem, rings_);
  EXPECT_GT(problem.report.unfolded, 0);
  EXPECT_LT(problem.report.energy_after, problem.report.energy_before);
  EXPECT_NEAR(problem.X(middle_, 2), 1, 0.02 * edge_);
  const std::vector<std::uint8_t> near = around(cube_.topology, {middle_}, 2);
  for (Index v = 0; v < X_.rows(); ++v) {
    EXPECT_TRUE(near[v] || problem.X.row(v) == X_.row(v)) << v;
  }
}

TEST_F(Spike, IsADetailWithoutNoise) {
  const FlowOptions options = keeping_creases(4);
  Points clean = X_, noisy = X_;
  EXPECT_EQ(willmore_flow(clean, cube_.topology, free_, options).unfolded, 0);
  EXPECT_GT(clean(middle_, 2), 1 + 0.05 * edge_);
  std::int64_t unfolded = 0;
  for (const int seed : {1, 2, 3, 4}) {
    noisy = X_;
    noisy.row(middle_) += edge_ * Vec3(0, 0, 1.5).transpose();
    add_noise(noisy, 0.3 * edge_, seed);
    unfolded += willmore_flow(noisy, cube_.topology, free_, options).unfolded;
    EXPECT_TRUE(spikes(noisy, free_).empty()) << seed;
  }
  EXPECT_GT(unfolded, 0);
}

}  // namespace
}  // namespace ibmfair::test
