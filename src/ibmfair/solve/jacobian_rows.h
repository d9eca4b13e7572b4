// The Jacobian J = D + h sum_s w_s c_s c_s^T by rows, in float32, for iterative solvers.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/energy/stencil_terms.h"

namespace ibmfair {

/// One column of four float32 per unknown: the three coordinates, and one that is idle so that a
/// column is one vector register.
using Quads = Eigen::Array<float, 4, Eigen::Dynamic>;

/// J restricted to the unknowns and divided by `unit`, the geometric mean of the smallest and the
/// largest entry of its diagonal, so that float32 holds both; symmetric positive definite. Rows are
/// kept as differences,
///
///   (J x)_u = a_u x_u + sum_v b_uv (x_v - x_u)
///
/// which float32 spoils less where x is smooth: the coefficients of a stencil sum to zero, so a_u
/// is D_u, plus what the stencil's held vertices have taken with them.
class JacobianRows {
 public:
  /// Refers to the terms and the unknowns.
  JacobianRows(const StencilTerms& terms, const Unknowns& unknowns);

  /// D: one positive entry per unknown; h > 0. Throws FactorizationFailed where an entry of the
  /// diagonal is not a positive number.
  void update(const StencilWeights& weights, const Eigen::VectorXd& D, double h);

  Index size() const { return unknowns_.size(); }
  /// Off the diagonal, a few zeros among them.
  std::int64_t entries() const { return columns_.first.back(); }

  double unit() const { return unit_; }

  /// unit / J_uu.
  const Eigen::VectorXf& inverse_diagonal() const { return inverse_diagonal_; }

  /// q = J p / unit, 4 x n each, and <p, q> over all coordinates. The same bytes for any number of
  /// threads.
  double apply(const Quads& p, Quads& q) const;

 private:
  void find_columns();
  void update_diagonal(const StencilWeights& weights, const Eigen::VectorXd& D, double h);
  double take_held(Index own, std::vector<double>& sum) const;

  const StencilTerms& terms_;
  const Unknowns& unknowns_;
  /// Of each unknown the others that share a stencil with it, and itself where they are odd in
  /// number.
  Rows columns_;
  std::vector<std::uint8_t> beside_held_;  // whether held vertices share one with it
  std::vector<float> b_;                   // as columns_.value
  Eigen::VectorXf a_;
  Eigen::VectorXf inverse_diagonal_;
  double unit_ = 1;
};

}  // namespace ibmfair
