#include "ibmfair/solve/symbolic_factor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "ibmfair/solve/elimination_tree.h"

namespace ibmfair {
namespace {

/// The values at the given places.
std::vector<Index> taken(const std::vector<Index>& values, const std::vector<Index>& places) {
  std::vector<Index> result(places.size());
  std::transform(places.begin(), places.end(), result.begin(), [&](Index i) { return values[i]; });
  return result;
}

/// Columns in postorder of the elimination tree.
struct Columns {
  std::vector<Index> parent;
  std::vector<Index> count;  ///< entries of L
};

/// Renumbers the columns: column i is the present column order[i].
Columns reordered(const Columns& columns, const std::vector<Index>& order) {
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<Index>(i);
  }
  Columns result{taken(columns.parent, order), taken(columns.count, order)};
  for (Index& parent : result.parent) {
    parent = parent < 0 ? parent : place[parent];
  }
  return result;
}

/// Consecutive columns that are stored with the same rows below them.
struct Group {
  Index first_column, columns;
  Index rows;              ///< of the first column
  std::int64_t zeros = 0;  ///< stored zeros, not counting those of tiny groups

  Index end() const { return first_column + columns; }
};

/// The group of `child` and of the columns that follow it, in `next`, the parent's group. Columns
/// of `child` get all the rows of `next`.
Group merged(const Group& child, const Group& next) {
  return {child.first_column, child.columns + next.columns, child.columns + next.rows, next.zeros};
}

/// Merges `child` into `next` if that adds few zeros [C. Ashcraft, R. Grimes, "The influence of
/// relaxed supernode partitions on the multifrontal method", ACM TOMS 15 (1989)]. The limits are
/// those of [Y. Chen, T. Davis, W. Hager, S. Rajamanickam, "Algorithm 887: CHOLMOD", ACM TOMS 35
/// (2008)].
bool merge_if_cheap(const Group& child, Group& next) {
  constexpr Index tiny = 4;
  struct Limit {
    Index columns;
    double zeros;  // share of all stored entries
  };
  constexpr Limit limits[] = {{16, 0.8}, {48, 0.1}, {std::numeric_limits<Index>::max(), 0.05}};

  Group both = merged(child, next);
  const std::int64_t columns = both.columns, below = both.rows - both.columns;
  const std::int64_t added = std::int64_t{child.columns} * (both.rows - child.rows);
  const bool is_tiny = columns <= tiny;
  both.zeros += is_tiny ? 0 : added;
  const double share = static_cast<double>(both.zeros) /
                       static_cast<double>(columns * (columns + 1) / 2 + columns * below);
  const bool is_cheap = is_tiny || added == 0 || std::ranges::any_of(limits, [&](Limit limit) {
                          return columns <= limit.columns && share < limit.zeros;
                        });
  if (is_cheap) next = both;
  return is_cheap;
}

/// The supernodes, from first to last. A fundamental supernode is a chain of columns, each the only
/// child of the next, with the same rows; some are then merged with their parents.
std::vector<Group> supernodes(const Columns& columns) {
  const std::vector<Index>&parent = columns.parent, &count = columns.count;
  const auto n = static_cast<Index>(parent.size());
  std::vector<Index> children(parent.size(), 0);
  for (const Index above : parent) {
    if (above >= 0) ++children[above];
  }
  std::vector<Group> groups;  // from last to first
  for (Index end = n, j = n - 1; j >= 0; --j) {
    const bool continues =
        j > 0 && parent[j - 1] == j && count[j - 1] == count[j] + 1 && children[j] == 1;
    if (continues) continue;
    const Group group{j, end - j, count[j]};
    const Index above = parent[end - 1];
    const bool is_before_parent = above >= 0 && above < groups.back().end();
    if (!is_before_parent || !merge_if_cheap(group, groups.back())) groups.push_back(group);
    end = j;
  }
  std::ranges::reverse(groups);
  return groups;
}

/// The supernodes with the rows of their fronts.
Supernodes with_rows(const std::vector<Group>& groups, const EliminationGraph& graph,
                     const std::vector<Index>& parent) {
  Supernodes nodes;
  nodes.first_column = {0};
  nodes.first_row = {0};
  std::vector<Index> owner(parent.size());  // the supernode of each column
  for (const Group& group : groups) {
    std::fill_n(owner.begin() + group.first_column, group.columns, nodes.size());
    nodes.first_column.push_back(group.end());
    nodes.first_row.push_back(nodes.first_row.back() + group.rows);
  }
  nodes.row.resize(static_cast<std::size_t>(nodes.first_row.back()));
  std::vector<std::int64_t> next(nodes.first_row.begin(), nodes.first_row.end() - 1);
  const auto add_row = [&](Index s, Index j) { nodes.row[next[s]++] = j; };
  std::vector<Index> last_row(groups.size(), -1);
  for (Index j = 0; j < graph.size(); ++j) {
    const Index own = owner[j];
    add_row(own, j);
    last_row[own] = j;
    for (const Index i : graph.before(j)) {
      // All supernodes on the path from i up to j have the row j.
      for (Index s = owner[i]; last_row[s] != j; s = owner[parent[nodes.first_column[s + 1] - 1]]) {
        add_row(s, j);
        last_row[s] = j;
      }
    }
  }
  return nodes;
}

}  // namespace

SymbolicFactor symbolic_factor(const CompressedRows& graph, const std::vector<Index>& order) {
  Columns columns;
  {
    const EliminationGraph given(graph, order);
    columns.parent = elimination_tree(given);
    columns.count = column_counts(given, columns.parent);
  }
  SymbolicFactor symbolic;
  for (const Index count : columns.count) {
    const double entries = count;
    symbolic.entries += entries;
    symbolic.flops += entries * entries;
  }
  // Children with many entries come last, next to their parents, with which they may share a
  // supernode.
  const std::vector<Index> last_are_full = postorder(columns.parent, columns.count);
  const std::vector<Index> unknown = taken(order, last_are_full);
  columns = reordered(columns, last_are_full);
  symbolic.nodes = with_rows(supernodes(columns), EliminationGraph(graph, unknown), columns.parent);
  symbolic.nodes.unknown = unknown;
  complete(symbolic.nodes);
  return symbolic;
}

}  // namespace ibmfair
