// The Jacobian J = D + h sum_s w_s c_s c_s^T by rows, in float32, for iterative solvers.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/row_sums.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// One column of four float32 numbers per unknown: the three coordinates and an unused number, so
/// that a column fills one vector register.
using Quads = Eigen::Array<float, 4, Eigen::Dynamic>;

/// J restricted to the unknowns and divided by `unit`, a power of two near the entries of its
/// diagonal, so that the entries are in the range of float32; symmetric positive definite. Rows are
/// stored in difference form,
///
///   (J x)_u = a_u x_u + sum_v b_uv (x_v - x_u)
///
/// which loses less accuracy in float32 if x is smooth. The coefficients of a stencil sum to zero,
/// so a_u is D_u minus the sum of h S_uv over the fixed vertices v.
class JacobianRows {
 public:
  /// Keeps a reference to `terms`.
  JacobianRows(const StencilTerms& terms, const Unknowns& unknowns);

  /// D has one positive entry per unknown; h > 0. Throws FactorizationFailed if an entry of the
  /// diagonal of J is not positive and finite.
  void update(const StencilWeights& weights, const Eigen::VectorXd& D, double h);

  Index size() const { return static_cast<Index>(sums_.size()); }
  /// The number of stored entries off the diagonal, including a few zeros.
  std::int64_t entries() const;

  double unit() const { return unit_; }

  /// unit / J_uu.
  const Eigen::VectorXf& inverse_diagonal() const { return inverse_diagonal_; }

  /// q = J p / unit, 4 x n each; returns <p, q>, summed over all coordinates. The result is
  /// bit-identical for any number of threads.
  double apply(const Quads& p, Quads& q) const;

 private:
  void fill(const StencilWeights& weights, const Eigen::VectorXd& D, double h);

  RowSums sums_;
  std::vector<Eigen::VectorXf> b_;  // laid out as the columns of the blocks; a_u in place of b_uu
  Eigen::VectorXd diagonal_;
  Eigen::VectorXf inverse_diagonal_;
  double unit_ = 1;  // kept as long as it suits the diagonal, to compute the rows only once
};

}  // namespace ibmfair
