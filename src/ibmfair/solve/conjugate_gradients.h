// Conjugate gradients on the three coordinates at once.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/solve/stencil_operator.h"

namespace ibmfair {

/// Solves J Y = B with the Jacobian of a StencilOperator in workspaces that are kept. Started from
/// zero, every iterate d of a coordinate satisfies <d, J d> = <d, b>: however few iterations there
/// are, it is a direction of descent, and the Gauss-Newton model holds along it.
class ConjugateGradients {
 public:
  /// Refers to the operator.
  explicit ConjugateGradients(StencilOperator& A) : A_(A) {}

  /// Iterates until the residual of every coordinate is `tolerance` times what it was (in the norm
  /// of diag(J)^-1), or `most_iterations` times. Returns the number of iterations.
  int solve(const Points& B, Points& Y, double tolerance, int most_iterations);

 private:
  StencilOperator& A_;
  Quads x_, r_, p_, q_;
};

}  // namespace ibmfair
