// Conjugate gradients for a displacement of the unknowns.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

/// Solves J Y = B by conjugate gradients preconditioned with diag(J), in workspaces that are kept.
/// The three coordinates are one vector, with one step length: so the result turns as B is turned.
/// Every iterate d ends up scaled so that <d, J d> = <d, b>, and is nearer to the solution than
/// zero is in the norm of J: however few iterations there are, it is a direction of descent, and
/// the Gauss-Newton model holds along it.
class ConjugateGradients {
 public:
  /// Refers to the Jacobian.
  explicit ConjugateGradients(const JacobianRows& J) : J_(J) {}

  /// Iterates until the residual is `tolerance` times that of zero (in the norm of diag(J)^-1), or
  /// `most_iterations` times. Returns the number of iterations. If Y has as many rows as B, its
  /// direction is the first that is gone along: of the steps of a flow, one is like the next.
  int solve(const Points& B, Points& Y, double tolerance, int most_iterations);

 private:
  double begin(const Points& B, double unit);
  std::optional<double> step(double slope, bool goes_on);
  double length_to_minimum(const Points& B, double unit) const;

  const JacobianRows& J_;
  Quads x_, r_, p_, q_;
};

}  // namespace ibmfair
