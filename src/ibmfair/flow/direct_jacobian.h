// The Jacobian assembled and factored.
#pragma once

#include <optional>

#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/jacobian_solver.h"
#include "ibmfair/solve/cholesky.h"

namespace ibmfair {

/// J is inexact by design ([W07] section 3.2), so float32 does for its factor as long as solves are
/// good to a part in a thousand; where that cannot be expected, or is not found, or where
/// `FlowOptions::solver_tolerance` asks for more, it is float64.
class DirectJacobian final : public JacobianSolver {
 public:
  explicit DirectJacobian(const JacobianShape& shape);

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;

 private:
  void assemble(const JacobianParts& parts);
  void factor(Precision precision);

  const JacobianShape shape_;
  HessianAssembler assembler_;
  SymmetricMatrix J_;
  Precision precision_ = Precision::float32;
  bool needs_float64_;  // it was asked for, or float32 was not enough once
  bool tried_ = false;  // the factor has solved well
  std::optional<SymbolicCholesky> symbolic_;
  std::optional<CholeskyFactor> factor_;
  std::optional<CholeskySolver> solver_;
};

/// The cost of a DirectJacobian: the iterations tell how often it is factored anew.
SolverForecast forecast_direct(const JacobianShape& shape, const IterationForecast& iterations);

}  // namespace ibmfair
