// The numbers of a sparse Cholesky factor by the multifrontal method (Duff and Reid 1983; Liu
// 1992): each supernode gathers its entries of the matrix and its children's updates into a dense
// front, factors its own columns, and hands the rest on to its parent. Dense kernels do the work,
// subtrees are independent, and the order of all sums is fixed by the tree.
#pragma once

#include <vector>

#include "ibmfair/base/huge_pages.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {

/// The factor of D^-1/2 J D^-1/2, D being the diagonal of J: rows of very different scale
/// (triangles of very different size) then cost no digits, and float32 does not overflow.
template <class Real>
class FrontalFactor {
 public:
  /// Refers to the tree.
  explicit FrontalFactor(const Supernodes& nodes);

  /// Returns -1, or the unknown at which the matrix is not positive definite.
  Index factor(const SymmetricMatrix& J, const EliminatedColumns& columns);

  const Supernodes& nodes() const { return nodes_; }
  /// Packed (solve/front_kernels.h).
  const Real* front(Index s) const { return values_.data() + first_value_[s]; }
  /// 1 / sqrt(J_ii), in order of elimination.
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

/// Solves with one factor in workspaces that are kept.
template <class Real>
class FrontalSolver {
 public:
  /// Refers to the factor.
  explicit FrontalSolver(const FrontalFactor<Real>& factor);

  /// Y = J^-1 B, n x 3 each; Y may be B.
  void solve(const Points& B, Points& Y);

 private:
  /// Where a thread works on one front.
  struct Scratch {
    LargeArray<Real> front;  // 4 numbers per row
    LargeArray<Real> workspace;
  };

  template <class List>
  void forward(const List& list, Real* stack, Scratch& scratch);
  void fetch_rows_before(Index s) const;
  void backward(Index s, Scratch& scratch);

  const FrontalFactor<Real>& factor_;
  LargeArray<Real> x_;                          // n x 4, in order of elimination
  std::vector<LargeArray<Real>> branch_stack_;  // for the updates within a branch
  LargeArray<Real> trunk_stack_;
  std::vector<Real*> update_;  // #S
  Index largest_front_ = 0;    // rows
};

}  // namespace ibmfair
