// Nested dissection: orderings are permutations, and separators separate.
#include "ibmfair/solve/ordering.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <gtest/gtest.h>

#include "ibmfair/base/threads.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/shapes.h"
#include "ibmfair/solve/separator.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The vertices of a mesh and its edges.
struct GraphInSpace {
  Points X;
  CompressedRows graph;
};

GraphInSpace example(const Mesh& mesh) {
  const State state(mesh);
  return {state.X, vertex_rings(state.topology)};
}

/// Two copies of an example, with no edge between the copies.
GraphInSpace twice(const GraphInSpace& one, const Vec3& apart) {
  GraphInSpace two = one;
  const Index n = one.graph.size();
  two.X.conservativeResize(2 * one.X.rows(), 3);
  two.X.bottomRows(one.X.rows()) = one.X.rowwise() + apart.transpose();
  for (Index v = 0; v < n; ++v) {
    for (const Index w : one.graph[v]) {
      two.graph.value.push_back(n + w);
    }
    two.graph.first.push_back(static_cast<std::int64_t>(two.graph.value.size()));
  }
  return two;
}

GraphInSpace sphere(int subdivide) {
  return example(make_shape("icosphere", {.subdivide = subdivide}));
}

bool is_permutation(std::vector<Index> order, Index size) {
  std::vector<Index> all(static_cast<std::size_t>(size));
  std::iota(all.begin(), all.end(), 0);
  std::sort(order.begin(), order.end());
  return order == all;
}

TEST(Orderings, ArePermutations) {
  std::vector<GraphInSpace> examples{
      {Points(0, 3), CompressedRows()}, sphere(5), twice(sphere(4), {3, 0, 0})};
  for (const auto& [name, mesh] : all_meshes()) {
    examples.push_back(example(mesh));
  }
  examples.push_back(sphere(3));
  std::fill(examples.back().graph.first.begin(), examples.back().graph.first.end(), 0);
  examples.back().graph.value.clear();
  for (const auto& [X, graph] : examples) {
    EXPECT_TRUE(is_permutation(minimum_degree(graph), graph.size()));
    EXPECT_TRUE(is_permutation(nested_dissection(graph, X), graph.size()));
  }
}

TEST(Orderings, AreTheSameForAnyNumberOfThreads) {
  const auto [X, graph] = sphere(5);
  set_thread_count(1);
  const std::vector<Index> order = nested_dissection(graph, X);
  set_thread_count(3);
  EXPECT_EQ(nested_dissection(graph, X), order);
  set_thread_count(0);
}

TEST(Orderings, GraphOfAMatrixHasItsEntriesAtBothEnds) {
  const SymmetricMatrix J{{0, 3, 4, 5}, {0, 1, 2, 1, 2}, {4, 1, 1, 4, 4}};
  const CompressedRows graph = graph_of(J);
  EXPECT_EQ(graph.first, (std::vector<std::int64_t>{0, 2, 3, 4}));
  EXPECT_EQ(graph.value, (std::vector<Index>{1, 2, 0, 0}));
}

/// The two sides and the separator together contain each node exactly once, and no edge joins the
/// sides.
void expect_separation(const CompressedRows& graph, const Separation& parts) {
  std::vector<int> where(static_cast<std::size_t>(graph.size()), -1);
  const auto mark = [&](const std::vector<Index>& nodes, int part) {
    for (const Index v : nodes) {
      EXPECT_EQ(where[v], -1) << v;
      where[v] = part;
    }
  };
  mark(parts.side[0], 0);
  mark(parts.side[1], 1);
  mark(parts.separator, 2);
  for (Index v = 0; v < graph.size(); ++v) {
    ASSERT_GE(where[v], 0);
    for (const Index w : graph[v]) {
      EXPECT_FALSE(where[v] == 0 && where[w] == 1) << v << " " << w;
    }
  }
}

TEST(Separators, LeaveNoEdgeBetweenSidesOfAFifthOrMore) {
  int cut = 0;
  for (const auto& [name, mesh] : all_meshes()) {
    const auto [X, graph] = example(mesh);
    const std::optional<Separation> parts = separate(graph, X);
    if (!parts) continue;
    ++cut;
    expect_separation(graph, *parts);
    for (const auto& side : parts->side) {
      EXPECT_GE(5 * side.size(), static_cast<std::size_t>(graph.size())) << name;
    }
  }
  EXPECT_GT(cut, 5);
}

/// A sphere of n vertices is cut by a great circle, or by a circle that is hardly smaller.
TEST(Separators, OfASphereAreRings) {
  for (const int subdivide : {3, 4, 5, 6}) {
    const auto [X, graph] = sphere(subdivide);
    const std::optional<Separation> parts = separate(graph, X);
    ASSERT_TRUE(parts);
    expect_separation(graph, *parts);
    EXPECT_LT(parts->separator.size(), 2.5 * std::sqrt(graph.size()));
  }
}

TEST(Separators, AreEmptyBetweenPieces) {
  const auto [X, graph] = twice(sphere(4), {3, 0, 0});
  const std::optional<Separation> parts = separate(graph, X);
  ASSERT_TRUE(parts);
  EXPECT_TRUE(parts->separator.empty());
  EXPECT_EQ(parts->side[0].size(), parts->side[1].size());
}

TEST(Separators, AreFoundWhereverTheMeshLiesAndWithNodesFarAway) {
  auto [X, graph] = sphere(5);
  const std::size_t plain = separate(graph, X)->separator.size();
  Points far = X;
  far.row(7) << 1e6, -1e7, 1e5;
  const std::optional<Separation> parts = separate(graph, far);
  ASSERT_TRUE(parts);
  expect_separation(graph, *parts);
  EXPECT_LT(parts->separator.size(), 1.5 * static_cast<double>(plain));
  X.rowwise() += Eigen::RowVector3d(1e8, -1e9, 3e7);
  EXPECT_LT(separate(graph, X)->separator.size(), 1.1 * static_cast<double>(plain));
}

TEST(Separators, AreTheSameAtAnyScale) {
  const auto [X, graph] = sphere(4);
  const std::vector<Index> separator = separate(graph, X)->separator;
  for (const int exponent : {-900, -100, 100, 900}) {
    const std::optional<Separation> parts = separate(graph, std::ldexp(1.0, exponent) * X);
    ASSERT_TRUE(parts) << exponent;
    EXPECT_EQ(parts->separator, separator) << exponent;
  }
}

TEST(Separators, AreNotFoundInAPointOrNowhere) {
  auto [X, graph] = sphere(3);
  EXPECT_FALSE(separate(graph, Points::Ones(X.rows(), 3)));
  EXPECT_FALSE(separate(graph, Points::Constant(X.rows(), 3, std::nan(""))));
  EXPECT_FALSE(separate(graph, HUGE_VAL * X));
  X(7, 1) = std::nan("");
  EXPECT_FALSE(separate(graph, X));
  EXPECT_FALSE(separate(CompressedRows(), Points(0, 3)));
}

}  // namespace
}  // namespace ibmfair::test
