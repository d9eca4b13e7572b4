// The Jacobian J = D + h S as a sparse matrix, for solvers that factor it.
#pragma once

#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {

/// The lower triangle of J, updated in place (energy/hessian.h).
class AssembledJacobian {
 public:
  /// Finds the pattern. Keeps references to what `shape` refers to.
  explicit AssembledJacobian(const JacobianShape& shape);

  /// Refills the values. Adds its time to the report.
  void update(const JacobianParts& parts);

  const SymmetricMatrix& matrix() const { return J_; }

 private:
  FlowReport& report_;
  HessianAssembler assembler_;
  SymmetricMatrix J_;
};

/// The predicted cost of a solver that factors the Jacobian, estimated from `iterations`, with its
/// analysis, its workspaces in float64 and the assembled matrix.
SolverForecast forecast_factor(const SolverTuning::Factorization& costs, const JacobianShape& shape,
                               const IterationForecast& iterations);

}  // namespace ibmfair
