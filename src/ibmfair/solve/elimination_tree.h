// The elimination tree of a sparse symmetric matrix, and what it tells about the Cholesky factor L
// before any number is known [J. Liu, "The role of elimination trees in sparse factorization", SIAM
// J. Matrix Anal. Appl. 11 (1990)]. Columns are numbered in elimination order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The graph of a matrix, with its columns numbered in elimination order.
class EliminationGraph {
 public:
  /// `graph` lists each edge at both ends; column j is its node order[j].
  EliminationGraph(const CompressedRows& graph, const std::vector<Index>& order);

  Index size() const { return static_cast<Index>(split_.size()); }
  /// The neighbours of column j that are eliminated before it, in no particular order.
  std::span<const Index> before(Index j) const { return between(first_[j], split_[j]); }
  /// The neighbours of column j that are eliminated after it, in no particular order.
  std::span<const Index> after(Index j) const { return between(split_[j], first_[j + 1]); }

 private:
  std::span<const Index> between(std::int64_t begin, std::int64_t end) const {
    return {neighbour_.data() + begin, static_cast<std::size_t>(end - begin)};
  }

  std::vector<std::int64_t> first_, split_;
  std::vector<Index> neighbour_;
};

/// The parent of each column j: the row of the first entry below the diagonal of column j of L, or
/// -1 if there is none.
std::vector<Index> elimination_tree(const EliminationGraph& graph);

/// The columns in a postorder of the tree: every subtree is a range that ends with its root. The
/// children of a column are in order of increasing `weight`, and those of equal weight in their
/// present order; an empty `weight` gives all the same weight.
std::vector<Index> postorder(const std::vector<Index>& parent, const std::vector<Index>& weight);

/// The number of entries of each column of L, with the diagonal [J. Gilbert, E. Ng, B. Peyton, "An
/// efficient algorithm to compute row and column counts for sparse Cholesky factorization", SIAM J.
/// Matrix Anal. Appl. 15 (1994)].
std::vector<Index> column_counts(const EliminationGraph& graph, const std::vector<Index>& parent);

}  // namespace ibmfair
