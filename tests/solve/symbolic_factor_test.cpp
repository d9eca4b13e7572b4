// The structure of the Cholesky factor, against elimination of one column after the other.
#include "ibmfair/solve/symbolic_factor.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "ibmfair/mesh/topology.h"
#include "ibmfair/solve/elimination_tree.h"
#include "ibmfair/solve/ordering.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The rows below the diagonal of each column of L. Eliminating a column connects all its later
/// neighbours with each other.
std::vector<std::set<Index>> eliminated(const EliminationGraph& graph) {
  std::vector<std::set<Index>> rows(static_cast<std::size_t>(graph.size()));
  for (Index j = 0; j < graph.size(); ++j) {
    rows[j].insert(graph.after(j).begin(), graph.after(j).end());
  }
  for (auto& column : rows) {
    for (auto i = column.begin(); i != column.end(); ++i) {
      rows[*i].insert(std::next(i), column.end());
    }
  }
  return rows;
}

struct NamedGraph {
  std::string name;
  CompressedRows graph;
  std::vector<Index> order;
};

/// The graphs of all meshes, of a path, of a star and of unconnected nodes, each in its own order,
/// by minimum degree and in a random order.
std::vector<NamedGraph> named_graphs() {
  std::vector<NamedGraph> graphs{{"nothing", CompressedRows(), {}}};
  const auto graph_from = [](Index nodes, const std::vector<std::pair<Index, Index>>& edges) {
    std::vector<std::set<Index>> neighbours(static_cast<std::size_t>(nodes));
    for (const auto& [a, b] : edges) {
      neighbours[a].insert(b);
      neighbours[b].insert(a);
    }
    CompressedRows graph;
    for (const auto& of_node : neighbours) {
      graph.value.insert(graph.value.end(), of_node.begin(), of_node.end());
      graph.first.push_back(std::ssize(graph.value));
    }
    return graph;
  };
  graphs.push_back({"apart", graph_from(5, {}), {}});
  graphs.push_back({"path", graph_from(6, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}}), {}});
  graphs.push_back({"star", graph_from(6, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}), {}});
  for (const auto& [name, mesh] : all_meshes()) {
    graphs.push_back({name, vertex_rings(State(mesh).topology), {}});
  }
  std::mt19937 generator(1);
  std::vector<NamedGraph> result;
  for (const NamedGraph& known : graphs) {
    std::vector<Index> order(static_cast<std::size_t>(known.graph.size()));
    std::iota(order.begin(), order.end(), 0);
    result.push_back({known.name + ", as it is", known.graph, order});
    std::shuffle(order.begin(), order.end(), generator);
    if (order.size() < 500) {
      result.push_back({known.name + ", random order", known.graph, order});
    }
    result.push_back({known.name + ", minimum degree", known.graph, minimum_degree(known.graph)});
  }
  return result;
}

TEST(EliminationTrees, HaveTheFirstRowOfEachColumnAsItsParent) {
  for (const auto& [name, graph, order] : named_graphs()) {
    const EliminationGraph ordered(graph, order);
    const auto rows = eliminated(ordered);
    const std::vector<Index> parent = elimination_tree(ordered);
    const std::vector<Index> count = column_counts(ordered, parent);
    ASSERT_EQ(parent.size(), rows.size()) << name;
    for (std::size_t j = 0; j < rows.size(); ++j) {
      EXPECT_EQ(parent[j], rows[j].empty() ? -1 : *rows[j].begin()) << name << " column " << j;
      EXPECT_EQ(count[j], static_cast<Index>(rows[j].size()) + 1) << name << " column " << j;
    }
  }
}

TEST(EliminationTrees, PostordersHaveEverySubtreeInARangeAndChildrenByWeight) {
  for (const auto& [name, graph, order] : named_graphs()) {
    const EliminationGraph ordered(graph, order);
    const std::vector<Index> parent = elimination_tree(ordered);
    const std::vector<Index> weight = column_counts(ordered, parent);
    const std::vector<Index> post = postorder(parent, weight);
    ASSERT_EQ(post.size(), parent.size()) << name;
    std::vector<Index> place(post.size(), -1);
    for (std::size_t i = 0; i < post.size(); ++i) {
      place[post[i]] = static_cast<Index>(i);
    }
    std::vector<Index> first = place, last_child(post.size(), -1);  // of each subtree
    for (const Index j : post) {
      const Index above = parent[j];
      ASSERT_GE(place[j], 0) << name;
      if (above < 0) continue;
      EXPECT_LT(place[j], place[above]) << name;
      if (last_child[above] >= 0) {
        const Index before = last_child[above];
        EXPECT_LE(std::pair(weight[before], before), std::pair(weight[j], j)) << name;
        EXPECT_EQ(first[j], place[before] + 1) << name << ": a gap between children";
      }
      last_child[above] = j;
      first[above] = std::min(first[above], first[j]);
    }
    for (std::size_t j = 0; j < post.size(); ++j) {
      if (last_child[j] >= 0) {
        EXPECT_EQ(place[last_child[j]] + 1, place[j]) << name;
      }
    }
  }
}

TEST(SymbolicFactors, HoldEveryEntryOfTheFactorAndFewZeros) {
  for (const auto& [name, graph, order] : named_graphs()) {
    const SymbolicFactor factor = symbolic_factor(graph, order);
    const Supernodes& nodes = factor.nodes;
    const auto rows = eliminated(EliminationGraph(graph, nodes.unknown));
    double entries = 0, flops = 0;
    Index column = 0;
    for (Index s = 0; s < nodes.size(); ++s) {
      ASSERT_EQ(nodes.first_column[s], column) << name;
      const auto begin = nodes.row.begin() + nodes.first_row[s],
                 end = nodes.row.begin() + nodes.first_row[s + 1];
      ASSERT_TRUE(std::is_sorted(begin, end)) << name;
      ASSERT_EQ(std::adjacent_find(begin, end), end) << name;
      for (Index own = 0; own < nodes.columns(s); ++own, ++column) {
        EXPECT_EQ(begin[own], column) << name;
        EXPECT_TRUE(std::includes(begin + own + 1, end, rows[column].begin(), rows[column].end()))
            << name << " column " << column;
        const double count = 1 + static_cast<double>(rows[column].size());
        entries += count;
        flops += count * count;
      }
      // Below its own columns, a supernode has the rows of its last column only.
      EXPECT_EQ(static_cast<std::size_t>(nodes.rows_below(s)), rows[column - 1].size()) << name;
    }
    EXPECT_EQ(column, nodes.unknowns()) << name;
    EXPECT_EQ(factor.entries, entries) << name;
    EXPECT_EQ(factor.flops, flops) << name;
    EXPECT_GE(static_cast<double>(nodes.entries), entries) << name;
    EXPECT_LE(static_cast<double>(nodes.entries), 2 * entries + 10) << name;
  }
}

}  // namespace
}  // namespace ibmfair::test
