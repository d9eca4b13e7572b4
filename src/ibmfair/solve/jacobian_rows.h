// The Jacobian J = D + h sum_s w_s c_s c_s^T by rows, in float32, for iterative solvers.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/row_sums.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// One column of four float32 per unknown: the three coordinates, and one that is idle so that a
/// column is one vector register.
using Quads = Eigen::Array<float, 4, Eigen::Dynamic>;

/// J restricted to the unknowns and divided by `unit`, a power of two not too far from the entries
/// of its diagonal, so that float32 holds them; symmetric positive definite. Rows are kept as
/// differences,
///
///   (J x)_u = a_u x_u + sum_v b_uv (x_v - x_u)
///
/// which float32 spoils less where x is smooth: the coefficients of a stencil sum to zero, so a_u
/// is D_u, plus what the stencil's held vertices have taken with them.
class JacobianRows {
 public:
  /// Refers to the terms.
  JacobianRows(const StencilTerms& terms, const Unknowns& unknowns);

  /// D: one positive entry per unknown; h > 0. Throws FactorizationFailed where an entry of the
  /// diagonal is not a positive number.
  void update(const StencilWeights& weights, const Eigen::VectorXd& D, double h);

  Index size() const { return static_cast<Index>(sums_.size()); }
  /// Off the diagonal, a few zeros among them.
  std::int64_t entries() const;

  double unit() const { return unit_; }

  /// unit / J_uu.
  const Eigen::VectorXf& inverse_diagonal() const { return inverse_diagonal_; }

  /// q = J p / unit, 4 x n each, and <p, q> over all coordinates. The same bytes for any number of
  /// threads.
  double apply(const Quads& p, Quads& q) const;

 private:
  void fill(const StencilWeights& weights, const Eigen::VectorXd& D, double h);

  RowSums sums_;
  std::vector<Eigen::VectorXf> b_;  // as the columns of its blocks; a_u in the place of b_uu
  Eigen::VectorXd diagonal_;
  Eigen::VectorXf inverse_diagonal_;
  double unit_ = 1;  // as long as it does, so that the rows are summed up once
};

}  // namespace ibmfair
