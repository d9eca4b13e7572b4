// The structure of a sparse Cholesky factor L, which is known before the numerical factorization:
// its columns in elimination order, grouped into supernodes (consecutive columns with the same rows
// below the diagonal block), and the tree along which each supernode passes its update to its
// parent.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A range of supernodes that depends on no supernode outside the range.
struct Branch {
  Index first, last;  ///< `last` is one past the end

  struct Iterator {
    Index s;
    Index operator*() const { return s; }
    Iterator& operator++() {
      ++s;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return s != other.s; }
  };
  Iterator begin() const { return {first}; }
  Iterator end() const { return {last}; }
};

/// Supernode s has the columns first_column[s] .. first_column[s + 1] - 1, which form a dense front
/// of `rows(s)` rows; the first rows are those of its own columns. Children come before their
/// parents, and every subtree is a contiguous range.
struct Supernodes {
  std::vector<Index> unknown;           ///< n, the unknowns in elimination order
  std::vector<Index> first_column;      ///< #S + 1
  std::vector<std::int64_t> first_row;  ///< #S + 1, indices into `row`
  std::vector<Index> row;               ///< rows of the fronts, increasing within each supernode
  std::int64_t entries = 0;             ///< entries of L on and below the diagonal
  CompressedRows children;              ///< #S
  std::vector<Index> place_in_parent;   ///< as `row`: the row's index in the parent's front

  /// The tree is split so that threads can share it: each of the `branches` consists of subtrees
  /// with at most a sixteenth of the work (or a fixed small amount, if this is more), and the
  /// `trunk` has the supernodes above them, in order. The split depends on the matrix only, so that
  /// sums never depend on the number of threads.
  std::vector<Branch> branches;
  std::vector<Index> trunk;
  std::vector<Index> branch_of;  ///< #S, the branch of each supernode, or -1 in the trunk

  Index size() const { return static_cast<Index>(first_column.size()) - 1; }
  Index unknowns() const { return static_cast<Index>(unknown.size()); }
  Index columns(Index s) const { return first_column[s + 1] - first_column[s]; }
  Index rows(Index s) const { return static_cast<Index>(first_row[s + 1] - first_row[s]); }
  /// The number of rows that belong to ancestors: the size of the update matrix.
  Index rows_below(Index s) const { return rows(s) - columns(s); }
};

/// The destinations of the entries of a matrix: column j of the factor takes value[source[k]] into
/// row place[k] of its front, for k = first[j] .. first[j + 1] - 1.
struct EliminatedColumns {
  std::vector<std::int64_t> first;
  std::vector<Index> place;
  std::vector<std::int64_t> source;
};

/// The destinations for the pattern of `J`.
EliminatedColumns eliminated_columns(const SymmetricMatrix& J, const Supernodes& nodes);

/// Computes all other members from unknown, first_column, first_row and row.
void complete(Supernodes& nodes);

}  // namespace ibmfair
