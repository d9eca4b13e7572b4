#include "ibmfair/solve/ordering.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/cholmod_context.h"

namespace ibmfair {
namespace {

/// An undirected graph with weights, every edge listed at both ends.
struct Graph {
  std::vector<std::int64_t> first{0};
  std::vector<Index> neighbour;
  std::vector<float> weight;

  Index size() const { return static_cast<Index>(first.size()) - 1; }
};

/// The graph of J; an edge weighs as much as the correlation |J_ij| / sqrt(J_ii J_jj).
Graph graph_of(const SymmetricMatrix& J) {
  const auto n = static_cast<std::size_t>(J.size());
  std::vector<double> scale(n);
  for (std::size_t j = 0; j < n; ++j) {
    scale[j] = 1 / std::sqrt(std::abs(J.value[J.column_first[j]]));
  }
  Graph graph;
  graph.first.assign(n + 1, 0);
  const auto each = [&](auto&& act) {
    for (std::int64_t j = 0; j < J.size(); ++j) {
      for (std::int64_t k = J.column_first[j] + 1; k < J.column_first[j + 1]; ++k) {
        act(static_cast<Index>(j), J.row[k], k);
      }
    }
  };
  each([&](Index j, std::int64_t i, std::int64_t) {
    ++graph.first[j + 1];
    ++graph.first[i + 1];
  });
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  graph.neighbour.resize(static_cast<std::size_t>(graph.first.back()));
  graph.weight.resize(graph.neighbour.size());
  std::vector<std::int64_t> next(graph.first.begin(), graph.first.end() - 1);
  each([&](Index j, std::int64_t i, std::int64_t k) {
    const auto weight = static_cast<float>(std::abs(J.value[k]) * scale[i] * scale[j]);
    graph.neighbour[next[j]] = static_cast<Index>(i);
    graph.weight[next[j]++] = weight;
    graph.neighbour[next[i]] = j;
    graph.weight[next[i]++] = weight;
  });
  return graph;
}

/// The group of each node, and the members of each group.
struct Grouping {
  std::vector<Index> group;
  Rows members;
};

/// Pairs each node, in order, with the free neighbour that it is tied to most.
Grouping pair_up(const Graph& graph) {
  Grouping pairs;
  pairs.group.assign(static_cast<std::size_t>(graph.size()), -1);
  for (Index i = 0; i < graph.size(); ++i) {
    if (pairs.group[i] >= 0) continue;
    Index mate = -1;
    float strongest = -1;
    for (std::int64_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      const Index j = graph.neighbour[k];
      if (j != i && pairs.group[j] < 0 && graph.weight[k] > strongest) {
        mate = j;
        strongest = graph.weight[k];
      }
    }
    const Index number = pairs.members.size();
    pairs.group[i] = number;
    pairs.members.value.push_back(i);
    if (mate >= 0) {
      pairs.group[mate] = number;
      pairs.members.value.push_back(mate);
    }
    pairs.members.first.push_back(static_cast<std::int64_t>(pairs.members.value.size()));
  }
  return pairs;
}

/// The graph of the groups; weights of parallel edges are summed.
Graph contract(const Graph& graph, const Grouping& grouping) {
  Graph coarse;
  std::vector<std::int64_t> seen(static_cast<std::size_t>(grouping.members.size()), -1);
  for (Index g = 0; g < grouping.members.size(); ++g) {
    const auto begin = static_cast<std::int64_t>(coarse.neighbour.size());
    for (const Index i : grouping.members[g]) {
      for (std::int64_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
        const Index other = grouping.group[graph.neighbour[k]];
        if (other == g) continue;
        if (seen[other] < begin) {
          seen[other] = static_cast<std::int64_t>(coarse.neighbour.size());
          coarse.neighbour.push_back(other);
          coarse.weight.push_back(0);
        }
        coarse.weight[seen[other]] += graph.weight[k];
      }
    }
    coarse.first.push_back(static_cast<std::int64_t>(coarse.neighbour.size()));
  }
  return coarse;
}

std::vector<std::int64_t> dissect(const Graph& graph) {
  CholmodContext context;
  std::vector<std::int64_t> row, column_first{0};  // the lower triangle
  for (Index j = 0; j < graph.size(); ++j) {
    for (std::int64_t k = graph.first[j]; k < graph.first[j + 1]; ++k) {
      if (graph.neighbour[k] > j) row.push_back(graph.neighbour[k]);
    }
    column_first.push_back(static_cast<std::int64_t>(row.size()));
  }
  cholmod_sparse A = lower_pattern(column_first, row);
  std::vector<std::int64_t> order(static_cast<std::size_t>(graph.size()));
  // METIS draws random numbers from one state for the whole process.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const bool ordered = cholmod_l_metis(&A, nullptr, 0, 0, order.data(), context.get()) != 0;
  context.check("ordering");
  if (!ordered) {
    throw FactorizationFailed("nested dissection failed");
  }
  return order;
}

}  // namespace

std::vector<Index> nested_dissection(const SymmetricMatrix& J) {
  const Graph graph = graph_of(J);
  const Grouping pairs = pair_up(graph);
  std::vector<Index> unknown;
  unknown.reserve(static_cast<std::size_t>(J.size()));
  for (const std::int64_t pair : dissect(contract(graph, pairs))) {
    const auto members = pairs.members[static_cast<Index>(pair)];
    unknown.insert(unknown.end(), members.begin(), members.end());
  }
  return unknown;
}

}  // namespace ibmfair
