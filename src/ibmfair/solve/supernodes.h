// The shape of a sparse Cholesky factor, known before any number is: its columns in order of
// elimination, grouped into supernodes of columns that have the same rows below, and the tree in
// which one supernode hands its update to the next.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A range of supernodes that depends on no supernode outside of it.
struct Branch {
  Index first, last;  ///< one past the end

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

/// Supernode s holds the columns first_column[s] .. first_column[s + 1] - 1 as a dense front of
/// `rows(s)` rows; its own columns are its first rows.
/// Children come before their parents, and every subtree is a contiguous range.
struct Supernodes {
  std::vector<Index> unknown;           ///< n, in order of elimination
  std::vector<Index> first_column;      ///< #S + 1
  std::vector<std::int64_t> first_row;  ///< #S + 1, into `row`
  std::vector<Index> row;               ///< increasing within each supernode
  std::int64_t entries = 0;             ///< on and below the diagonal, in all columns
  Rows children;                        ///< #S
  std::vector<Index> place_in_parent;   ///< as `row`: the place of the row among the parent's

  /// Subtrees of a sixteenth of the work or less, for threads to share, and the supernodes above
  /// them, in order. The split depends on the matrix only, so that sums never depend on the
  /// number of threads.
  std::vector<Branch> branches;
  std::vector<Index> trunk;
  std::vector<Index> branch_of;  ///< #S, or -1 in the trunk

  Index size() const { return static_cast<Index>(first_column.size()) - 1; }
  Index unknowns() const { return static_cast<Index>(unknown.size()); }
  Index columns(Index s) const { return first_column[s + 1] - first_column[s]; }
  Index rows(Index s) const { return static_cast<Index>(first_row[s + 1] - first_row[s]); }
  /// The rows that belong to ancestors: the side of the update matrix.
  Index rows_below(Index s) const { return rows(s) - columns(s); }
};

/// Where the entries of a matrix go: column j of the factor takes value[source[k]] into row
/// place[k] of its front, for k = first[j] .. first[j + 1] - 1.
struct EliminatedColumns {
  std::vector<std::int64_t> first;
  std::vector<Index> place;
  std::vector<std::int64_t> source;
};

/// For the pattern of `J`.
EliminatedColumns eliminated_columns(const SymmetricMatrix& J, const Supernodes& nodes);

/// Fills in what follows from unknown, first_column, first_row and row: everything else.
void complete(Supernodes& nodes);

}  // namespace ibmfair
