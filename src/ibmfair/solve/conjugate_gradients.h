// Conjugate gradients for a displacement of the unknown vertices.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

/// Solves J Y = B by conjugate gradients preconditioned with diag(J). Workspaces are reused between
/// solves. The three coordinates form a single vector with one step length, so the result rotates
/// with B. The returned Y is scaled such that <Y, J Y> = <Y, B>, and in the norm of J it is nearer
/// to the solution than zero is. However few iterations are made, Y is therefore a descent
/// direction, and the Gauss-Newton model is exact along it.
class ConjugateGradients {
 public:
  /// Keeps a reference to `J`.
  explicit ConjugateGradients(const JacobianRows& J) : J_(J) {}

  /// Iterates until the residual is at most `tolerance` times the residual of Y = 0 (in the norm of
  /// diag(J)^-1), but at most `most_iterations` times. Returns the number of iterations. If Y has
  /// as many rows as B, its direction is the first search direction: successive steps of a flow
  /// have similar directions.
  int solve(const Points& B, Points& Y, double tolerance, int most_iterations);

 private:
  double begin(const Points& B, double unit);
  std::optional<double> step(double slope, bool goes_on);
  double length_to_minimum(const Points& B, double unit) const;

  const JacobianRows& J_;
  Quads x_, r_, p_, q_;
};

}  // namespace ibmfair
