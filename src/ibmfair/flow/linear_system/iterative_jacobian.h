// The Jacobian as an operator that is applied to vectors. Systems are solved by conjugate
// gradients, without a factorization and with the memory of a few vectors.
#pragma once

#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/solve/conjugate_gradients.h"
#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

/// Conjugate gradients with the diagonal of J as preconditioner (solve/conjugate_gradients.h).
class IterativeJacobian final : public JacobianSolver {
 public:
  explicit IterativeJacobian(const JacobianShape& shape);

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;
  bool solve_within(double& seconds, const Points& B, Points& Y) override;
  void tighten(double tolerance) override;

 private:
  const JacobianShape shape_;
  JacobianRows J_;
  ConjugateGradients solver_;
  double tolerance_;
};

/// The number of iterations after which a solve to the relative residual `tolerance` is given up:
/// SolverTuning::most_iterations, or more in proportion to the number of digits asked for.
int most_iterations(double tolerance);

/// The predicted cost of an IterativeJacobian.
SolverForecast forecast_iterative(const JacobianShape& shape, const IterationForecast& iterations);

}  // namespace ibmfair
