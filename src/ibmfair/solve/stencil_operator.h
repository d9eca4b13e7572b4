// The Jacobian J = D + h sum_s w_s c_s c_s^T as what it does to a vector, without being assembled.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

/// One column of four float32 per unknown: the three coordinates, and one that is idle so that a
/// column is one vector register.
using Quads = Eigen::Array<float, 4, Eigen::Dynamic>;

/// J between its square-rooted diagonals, A = N^-1/2 J N^-1/2 with N = diag(J), restricted to the
/// unknowns: symmetric positive definite with ones on the diagonal.
class StencilOperator {
 public:
  /// Refers to the stencils.
  StencilOperator(const Rows& stencils, const Unknowns& unknowns);

  /// D: one positive entry per unknown; h > 0. Throws FactorizationFailed where an entry of the
  /// diagonal is not a positive number.
  void update(const StencilWeights& weights, const Eigen::VectorXd& D, double h);

  Index size() const { return static_cast<Index>(unknown_places_.size()); }

  /// 1 / sqrt(J_uu).
  const Eigen::VectorXd& scale() const { return scale_; }

  /// q = A p, 4 x n each. The same bytes for any number of threads.
  void apply(const Quads& p, Quads& q);

 private:
  const Rows& stencils_;
  std::vector<Index> place_unknown_;    // as stencils_.value: the unknown, or 0 where it is held
  std::vector<float> place_c_;          // sqrt(h w) c / sqrt(J_uu), or 0 where it is held
  Rows unknown_places_;                 // n rows: positions in stencils_.value
  std::vector<Index> unknown_stencil_;  // as unknown_places_.value
  std::vector<float> unknown_c_;        // likewise: place_c_ once more, to be read in order
  Eigen::VectorXd scale_;
  Eigen::VectorXf identity_;  // D / diag(J)
  Quads z_;                   // one column per stencil
};

}  // namespace ibmfair
