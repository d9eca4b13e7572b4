// The numerical factorization of a sparse matrix by the multifrontal method (Duff and Reid 1983;
// Liu 1992). Each supernode has a front, a dense matrix into which it gathers its entries of the
// matrix and the updates of its children. The supernode factors its own columns of the front and
// passes the remaining part on to its parent as an update. Dense kernels do the work, subtrees are
// independent, and the order of all sums is fixed by the elimination tree.
#pragma once

#include <vector>

#include "ibmfair/base/huge_pages.h"
#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {

/// The Cholesky factor of D^-1/2 J D^-1/2, where D is the diagonal of J. With this scaling, rows of
/// very different size (from triangles of very different size) lose no digits, and float32 does not
/// overflow.
template <class Real>
class FrontalFactor {
 public:
  /// Keeps a reference to `nodes`.
  explicit FrontalFactor(const Supernodes& nodes);

  /// Returns -1, or the first unknown found at which the matrix is not positive definite.
  Index factor(const SymmetricMatrix& J, const EliminatedColumns& columns);

  const Supernodes& nodes() const { return nodes_; }
  /// The packed numbers of front s (solve/front_kernels.h).
  const Real* front(Index s) const { return values_.data() + first_value_[s]; }
  /// 1 / sqrt(J_ii), in elimination order.
  const std::vector<double>& scale() const { return scale_; }
  double largest_scale() const { return largest_scale_; }

 private:
  class Pass;

  const Supernodes& nodes_;
  std::vector<std::int64_t> first_value_;  // #S + 1
  LargeArray<Real> values_;
  std::vector<double> scale_;
  double largest_scale_ = 0;
};

/// Solves with one factor. Workspaces are reused between solves.
template <class Real>
class FrontalSolver {
 public:
  /// Keeps a reference to `factor`.
  explicit FrontalSolver(const FrontalFactor<Real>& factor);

  /// Y = J^-1 B, n x 3 each; Y may be B.
  void solve(const Points& B, Points& Y);

 private:
  /// A thread's workspace for one front.
  struct Scratch {
    LargeArray<Real> front;  // 4 numbers per row
    LargeArray<Real> workspace;
  };

  template <class List>
  void forward(const List& list, Real* stack, Scratch& scratch);
  void fetch_rows_before(Index s) const;
  void backward(Index s, Scratch& scratch);

  const FrontalFactor<Real>& factor_;
  LargeArray<Real> x_;                          // n x 4, in elimination order
  std::vector<LargeArray<Real>> branch_stack_;  // for the updates within a branch
  LargeArray<Real> trunk_stack_;
  std::vector<Real*> update_;  // #S
  Index largest_front_ = 0;    // rows
};

}  // namespace ibmfair
