#include "ibmfair/solve/ordering.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <amd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/sort_into_rows.h"
#include "ibmfair/solve/separator.h"

namespace ibmfair {
namespace {

/// Graphs of at most this size are ordered by minimum degree. Half this size makes the ordering
/// take a tenth longer and saves a hundredth of the operations.
constexpr Index left_to_minimum_degree = 200;

/// The number of unknowns from which on nested dissection takes less time in total. The value was
/// chosen from the output of tools/ordering_table.
constexpr Index worth_dissecting = 6'000;

/// Some of the nodes, and the start of their range in the elimination order.
struct Nodes {
  std::vector<Index> node;
  std::int64_t begin = 0;
};

/// Some of the nodes with the edges between them, numbered from 0.
struct Part {
  Nodes nodes;
  CompressedRows graph;
};

/// The subgraph on `nodes`. `number` is the index of each node in `nodes`, and -1 for all other
/// nodes that share an edge with one of them.
CompressedRows subgraph(const CompressedRows& graph, const std::vector<Index>& nodes,
                        const std::vector<Index>& number) {
  CompressedRows sub;
  sub.first.reserve(nodes.size() + 1);
  for (const Index v : nodes) {
    for (const Index w : graph[v]) {
      if (number[w] >= 0) sub.value.push_back(number[w]);
    }
    sub.first.push_back(static_cast<std::int64_t>(sub.value.size()));
  }
  return sub;
}

/// Finds a separator of the subgraph `graph` on the given nodes and writes it to `order`. Returns
/// the two sides; or nothing if there is no separator, after all nodes have been written to
/// `order`.
std::vector<Part> dissect(const CompressedRows& graph, const Nodes& nodes, const Points& X,
                          std::vector<Index>& order) {
  const auto node = [&](Index i) { return nodes.node[i]; };
  std::optional<Separation> cut;
  if (graph.size() > left_to_minimum_degree) {
    cut = separate(graph, X(nodes.node, Eigen::all));
  }
  if (!cut) {
    const std::vector<Index> by_degree = minimum_degree(graph);
    std::transform(by_degree.begin(), by_degree.end(), order.begin() + nodes.begin, node);
    return {};
  }
  std::vector<Index> number(nodes.node.size(), -1);
  for (const auto& side : cut->side) {
    for (std::size_t i = 0; i < side.size(); ++i) {
      number[side[i]] = static_cast<Index>(i);
    }
  }
  std::vector<Part> sides(cut->side.size());
  std::int64_t begin = nodes.begin;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::vector<Index>& side = cut->side[i];
    sides[i].nodes.node.reserve(side.size());
    std::transform(side.begin(), side.end(), std::back_inserter(sides[i].nodes.node), node);
    sides[i].graph = subgraph(graph, side, number);
    sides[i].nodes.begin = begin;
    begin += std::ssize(side);
  }
  std::transform(cut->separator.begin(), cut->separator.end(), order.begin() + begin, node);
  return sides;
}

}  // namespace

CompressedRows graph_of(const SymmetricMatrix& J) {
  return sort_into_rows(static_cast<Index>(J.size()), std::ssize(J.row), [&](const auto& put) {
    for (std::int64_t j = 0; j < J.size(); ++j) {
      for (std::int64_t k = J.column_first[j] + 1; k < J.column_first[j + 1]; ++k) {
        put(j, J.row[k]);
        put(J.row[k], static_cast<Index>(j));
      }
    }
  });
}

std::vector<Index> minimum_degree(const CompressedRows& graph) {
  std::vector<Index> order(static_cast<std::size_t>(graph.size()));
  std::iota(order.begin(), order.end(), 0);
  if (graph.value.empty()) return order;  // AMD takes no null pointer
  if (graph.first.back() > std::numeric_limits<Index>::max()) {
    throw OutOfMemory("the graph of the sparse ordering is larger than its index type");
  }
  const std::vector<Index> first(graph.first.begin(), graph.first.end());
  const int status =
      amd_order(graph.size(), first.data(), graph.value.data(), order.data(), nullptr, nullptr);
  if (status == AMD_OUT_OF_MEMORY) {
    throw OutOfMemory("out of memory in the sparse ordering");
  }
  return order;
}

std::vector<Index> nested_dissection(const CompressedRows& graph, const Points& X) {
  std::vector<Index> order(static_cast<std::size_t>(graph.size()));
  std::vector<Index> all = order;
  std::iota(all.begin(), all.end(), 0);
  std::vector<Part> parts = dissect(graph, {std::move(all), 0}, X, order);
  while (!parts.empty()) {
    std::vector<std::vector<Part>> sides(parts.size());
    parallel_tasks(std::ssize(parts), [&](std::int64_t i) {
      sides[i] = dissect(parts[i].graph, parts[i].nodes, X, order);
      parts[i] = {};
    });
    parts.clear();
    for (std::vector<Part>& of_part : sides) {
      std::move(of_part.begin(), of_part.end(), std::back_inserter(parts));
    }
  }
  return order;
}

EliminationOrder elimination_order(const CompressedRows& graph, const Points& X) {
  return graph.size() < worth_dissecting
             ? EliminationOrder{"minimum degree", minimum_degree(graph)}
             : EliminationOrder{"nested dissection", nested_dissection(graph, X)};
}

}  // namespace ibmfair
