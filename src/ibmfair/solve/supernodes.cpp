#include "ibmfair/solve/supernodes.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

/// The parent of every supernode, or -1. The parent is the supernode that owns the first row below
/// the child's own columns.
std::vector<Index> parents(const Supernodes& nodes) {
  std::vector<Index> owner(nodes.unknown.size());
  for (Index s = 0; s < nodes.size(); ++s) {
    std::fill(owner.begin() + nodes.first_column[s], owner.begin() + nodes.first_column[s + 1], s);
  }
  std::vector<Index> parent(static_cast<std::size_t>(nodes.size()), -1);
  for (Index s = 0; s < nodes.size(); ++s) {
    if (nodes.rows_below(s) > 0) {
      parent[s] = owner[nodes.row[nodes.first_row[s] + nodes.columns(s)]];
    }
  }
  return parent;
}

/// Both lists of rows are increasing, and the parent's list contains every row of the child below
/// its own columns.
void place_rows(Supernodes& nodes, const std::vector<Index>& parent) {
  nodes.place_in_parent.resize(nodes.row.size());
  for (Index s = 0; s < nodes.size(); ++s) {
    if (parent[s] < 0) continue;
    const Index* const first = nodes.row.data() + nodes.first_row[parent[s]];
    const Index* at = first;
    for (std::int64_t k = nodes.first_row[s] + nodes.columns(s); k < nodes.first_row[s + 1]; ++k) {
      while (*at != nodes.row[k])
        ++at;
      nodes.place_in_parent[k] = static_cast<Index>(at - first);
    }
  }
}

void split_for_threads(Supernodes& nodes, const std::vector<Index>& parent) {
  constexpr double pieces = 16, worth_a_thread = 1e6;                // floating-point operations
  std::vector<double> work(static_cast<std::size_t>(nodes.size()));  // of the subtree
  double total = 0;
  for (Index s = 0; s < nodes.size(); ++s) {
    const double rows = nodes.rows(s);
    const double own = nodes.columns(s) * rows * rows;
    work[s] += own;
    total += own;
    if (parent[s] >= 0) work[parent[s]] += work[s];
  }
  const double limit = std::max(total / pieces, worth_a_thread);
  double taken = 0;  // work in the last branch
  Index begin = 0;   // start of the subtrees that are not yet in a branch
  for (Index s = 0; s < nodes.size(); ++s) {
    const bool in_trunk = work[s] > limit;
    if (in_trunk) {
      nodes.trunk.push_back(s);
      begin = s + 1;
    } else if (parent[s] < 0 || work[parent[s]] > limit) {  // the root of a subtree
      const bool joins = !nodes.branches.empty() && nodes.branches.back().last == begin &&
                         taken + work[s] <= limit;
      if (!joins) {
        nodes.branches.push_back({begin, begin});
        taken = 0;
      }
      nodes.branches.back().last = begin = s + 1;
      taken += work[s];
    }
  }
  nodes.branch_of.assign(static_cast<std::size_t>(nodes.size()), -1);
  for (std::size_t b = 0; b < nodes.branches.size(); ++b) {
    std::fill(nodes.branch_of.begin() + nodes.branches[b].first,
              nodes.branch_of.begin() + nodes.branches[b].last, static_cast<Index>(b));
  }
}

}  // namespace

EliminatedColumns eliminated_columns(const SymmetricMatrix& J, const Supernodes& nodes) {
  const std::size_t n = nodes.unknown.size();
  std::vector<Index> turn(n);
  for (std::size_t i = 0; i < n; ++i) {
    turn[nodes.unknown[i]] = static_cast<Index>(i);
  }
  EliminatedColumns columns;
  columns.first.assign(n + 1, 0);
  columns.place.resize(J.row.size());
  columns.source.resize(J.row.size());
  const auto each = [&](const auto& act) {
    parallel_ranges(J.size(), std::ssize(J.row), [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t j = 0; j < J.size(); ++j) {
        for (std::int64_t k = J.column_first[j]; k < J.column_first[j + 1]; ++k) {
          const auto [column, row] = std::minmax(turn[j], turn[J.row[k]]);
          if (column >= first && column < last) act(column, row, k);
        }
      }
    });
  };
  each([&](Index column, Index, std::int64_t) { ++columns.first[column + 1]; });
  std::partial_sum(columns.first.begin(), columns.first.end(), columns.first.begin());
  std::vector<std::int64_t> next(columns.first.begin(), columns.first.end() - 1);
  each([&](Index column, Index row, std::int64_t k) {
    columns.place[next[column]] = row;
    columns.source[next[column]++] = k;
  });
  std::vector<Index>& place = turn;
  for (Index s = 0; s < nodes.size(); ++s) {
    for (Index i = 0; i < nodes.rows(s); ++i) {
      place[nodes.row[nodes.first_row[s] + i]] = i;
    }
    for (std::int64_t k = columns.first[nodes.first_column[s]];
         k < columns.first[nodes.first_column[s + 1]]; ++k) {
      columns.place[k] = place[columns.place[k]];
    }
  }
  return columns;
}

void complete(Supernodes& nodes) {
  nodes.entries = 0;
  for (Index s = 0; s < nodes.size(); ++s) {
    const std::int64_t columns = nodes.columns(s);
    nodes.entries += columns * nodes.rows(s) - columns * (columns - 1) / 2;
  }
  const std::vector<Index> parent = parents(nodes);
  nodes.children = positions_by_value(parent, nodes.size());
  place_rows(nodes, parent);
  split_for_threads(nodes, parent);
}

}  // namespace ibmfair
