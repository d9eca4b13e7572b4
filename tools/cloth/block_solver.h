// Newton's linear systems: the Hessian of all terms and the inertia, over the vertices that move.
#pragma once

#include <optional>

#include "cloth/block_hessian.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair::cloth {

/// Factors J = diag(d) + H by the library's sparse Cholesky factorization, three unknowns a vertex.
/// The pattern is analysed once.
class BlockSolver {
 public:
  /// H gives the pattern; `fixed` is #V; `rest` is #V x 3, the approximate positions.
  BlockSolver(const BlockHessian& H, const std::vector<std::uint8_t>& fixed, const Points& rest);

  /// d: #V. Throws FactorizationFailed where J is not positive definite.
  void factor(const BlockHessian& H, const PerVertex& d);

  /// D = J^-1 G over the vertices that move, 0 at the others; #V x 3 each.
  void solve(const Points& G, Points& D);

 private:
  Unknowns unknowns_;
  SymmetricMatrix J_;
  std::vector<std::int64_t>
      source_;  // for each value of J_, its index among the values of the blocks
  std::optional<MultifrontalCholesky> cholesky_;
  Points right_hand_side_;
};

}  // namespace ibmfair::cloth
