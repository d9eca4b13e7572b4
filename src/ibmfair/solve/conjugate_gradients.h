// Conjugate gradients for a displacement of the unknowns.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

/// Solves J Y = B by conjugate gradients preconditioned with diag(J), in workspaces that are kept.
/// The three coordinates are one vector, with one step length: so the result turns as B is turned.
/// Started from zero, every iterate d satisfies <d, J d> = <d, b>: however few iterations there
/// are, it is a direction of descent, and the Gauss-Newton model holds along it.
class ConjugateGradients {
 public:
  /// Refers to the Jacobian.
  explicit ConjugateGradients(const JacobianRows& J) : J_(J) {}

  /// Iterates until the residual is `tolerance` times what it was (in the norm of diag(J)^-1), or
  /// `most_iterations` times. Returns the number of iterations.
  int solve(const Points& B, Points& Y, double tolerance, int most_iterations);

 private:
  const JacobianRows& J_;
  Quads x_, r_, p_, q_;
};

}  // namespace ibmfair
