// The Jacobian as what it does to a vector, solved with by conjugate gradients: no factor, and the
// memory of a few vectors.
#pragma once

#include "ibmfair/flow/jacobian_solver.h"
#include "ibmfair/solve/conjugate_gradients.h"
#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

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

/// The iterations after which a solve to that residual is given up: every digit takes as many.
int most_iterations(double tolerance);

/// The cost of an IterativeJacobian.
SolverForecast forecast_iterative(const JacobianShape& shape, const IterationForecast& iterations);

}  // namespace ibmfair
