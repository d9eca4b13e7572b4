// The Jacobian as a sparse matrix, factored by the multifrontal method.
#pragma once

#include <optional>

#include "ibmfair/flow/linear_system/assembled_jacobian.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair {

/// J is inexact by design ([W07] section 3.2), so a factorization in float32 is accurate enough as
/// long as the relative residual of solves is below 1e-3. The factorization uses float64 if the
/// matrix is too badly scaled for that, if a solve misses it, or if `FlowOptions::solver_tolerance`
/// is below 1e-4.
class MultifrontalJacobian final : public JacobianSolver {
 public:
  explicit MultifrontalJacobian(const JacobianShape& shape);

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;

 private:
  void factor(Precision precision);

  const JacobianShape shape_;
  AssembledJacobian J_;
  Precision precision_ = Precision::float32;
  bool needs_float64_;  // float64 was requested, or float32 has once been insufficient
  bool tried_ = false;  // the accuracy of the factorization is known to suffice
  std::optional<MultifrontalAnalysis> analysis_;
  std::optional<MultifrontalCholesky> cholesky_;
};

/// The predicted cost of a MultifrontalJacobian.
SolverForecast forecast_multifrontal(const JacobianShape& shape,
                                     const IterationForecast& iterations);

}  // namespace ibmfair
