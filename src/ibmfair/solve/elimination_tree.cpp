#include "ibmfair/solve/elimination_tree.h"

#include <algorithm>
#include <numeric>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

/// The number of columns in the subtree of each column.
std::vector<Index> subtree_sizes(const std::vector<Index>& parent) {
  std::vector<Index> size(parent.size(), 1);
  for (std::size_t j = 0; j < parent.size(); ++j) {
    if (parent[j] >= 0) size[parent[j]] += size[j];
  }
  return size;
}

/// Finds the lowest common ancestor of columns that are visited in postorder.
class Ancestors {
 public:
  explicit Ancestors(std::size_t columns) : above_(columns) {
    std::iota(above_.begin(), above_.end(), 0);
  }

  /// To be called for a column once it and its subtree have been visited.
  void leave(Index j, Index parent) {
    if (parent >= 0) above_[j] = parent;
  }

  /// The lowest ancestor of `j`, or j itself, that has not been left.
  Index find(Index j) {
    while (above_[j] != j) {
      above_[j] = above_[above_[j]];
      j = above_[j];
    }
    return j;
  }

 private:
  std::vector<Index> above_;
};

}  // namespace

EliminationGraph::EliminationGraph(const CompressedRows& graph, const std::vector<Index>& order)
    : first_(order.size() + 1, 0), split_(order.size()), neighbour_(graph.value.size()) {
  std::vector<Index> turn(order.size());
  for (std::size_t j = 0; j < order.size(); ++j) {
    turn[order[j]] = static_cast<Index>(j);
    first_[j + 1] = first_[j] + std::ssize(graph[order[j]]);
  }
  parallel_for(size(), [&](std::int64_t j) {
    // Fills the range from both ends, without an unpredictable branch.
    std::int64_t before_end = first_[j], after_begin = first_[j + 1];
    for (const Index v : graph[order[j]]) {
      const bool is_before = turn[v] < j;
      neighbour_[is_before ? before_end : after_begin - 1] = turn[v];
      before_end += is_before ? 1 : 0;
      after_begin -= is_before ? 0 : 1;
    }
    split_[j] = before_end;
  });
}

std::vector<Index> elimination_tree(const EliminationGraph& graph) {
  std::vector<Index> parent(static_cast<std::size_t>(graph.size()), -1);
  std::vector<Index> root = parent;  // a shortcut to an ancestor; -1 for the roots so far
  for (Index j = 0; j < graph.size(); ++j) {
    for (Index i : graph.before(j)) {
      // Column j becomes the parent of the root above i.
      while (i != j) {
        const Index above = root[i];
        root[i] = j;
        if (above < 0) parent[i] = j;
        i = above < 0 ? j : above;
      }
    }
  }
  return parent;
}

std::vector<Index> postorder(const std::vector<Index>& parent, const std::vector<Index>& weight) {
  const auto n = static_cast<Index>(parent.size());
  CompressedRows children = positions_by_value(parent, n);
  if (!weight.empty()) {
    for (Index j = 0; j < n; ++j) {
      std::stable_sort(children.value.begin() + children.first[j],
                       children.value.begin() + children.first[j + 1],
                       [&](Index a, Index b) { return weight[a] < weight[b]; });
    }
  }
  const std::vector<Index> size = subtree_sizes(parent);
  std::vector<Index> begin(parent.size());  // of the subtree's range
  Index end_of_roots = 0;
  for (Index j = 0; j < n; ++j) {
    if (parent[j] < 0) {
      begin[j] = end_of_roots;
      end_of_roots += size[j];
    }
  }
  std::vector<Index> order(parent.size());
  for (Index j = n - 1; j >= 0; --j) {  // parents before their children
    Index next = begin[j];
    for (const Index child : children[j]) {
      begin[child] = next;
      next += size[child];
    }
    order[next] = j;
  }
  return order;
}

std::vector<Index> column_counts(const EliminationGraph& graph, const std::vector<Index>& parent) {
  const std::vector<Index> order = postorder(parent, {}), size = subtree_sizes(parent);
  // Row i of L has an entry in column j if j is on the path from a neighbour of i up to i. These
  // paths form a subtree of which i is the root. A column's count is the sum over its descendants j
  // of the number of rows of whose subtree j is a leaf, less the rows at which two such paths meet,
  // and less one for each child, whose own row ends there.
  std::vector<Index> count(parent.size(), 0);
  std::vector<Index> last_leaf(parent.size(), -1);   // of each row: the last one found
  std::vector<Index> last_place(parent.size(), -1);  // its place in the postorder
  Ancestors ancestors(parent.size());
  for (Index place = 0; place < graph.size(); ++place) {
    const Index j = order[place];
    count[j] += size[j] == 1 ? 1 : 0;
    if (parent[j] >= 0) --count[parent[j]];
    const Index first_descendant = place - size[j] + 1;
    for (const Index i : graph.after(j)) {
      if (last_place[i] < first_descendant) {  // no leaf so far is below j
        ++count[j];
        if (last_leaf[i] >= 0) --count[ancestors.find(last_leaf[i])];
        last_leaf[i] = j;
        last_place[i] = place;
      }
    }
    ancestors.leave(j, parent[j]);
  }
  for (std::size_t j = 0; j < parent.size(); ++j) {
    if (parent[j] >= 0) count[parent[j]] += count[j];
  }
  return count;
}

}  // namespace ibmfair
