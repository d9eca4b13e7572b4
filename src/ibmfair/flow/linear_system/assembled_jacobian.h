// The Jacobian J = D + h S as a sparse matrix, for solvers that factor it.
#pragma once

#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"

namespace ibmfair {

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

/// The number of numeric factorizations in the remaining steps, estimated from `iterations`.
double forecast_factorizations(const JacobianShape& shape, const IterationForecast& iterations);

/// The size and cost of a triangular factor for `unknowns` unknowns on a surface, which has small
/// separators.
double forecast_factor_entries(double unknowns);
double forecast_factor_flops(double unknowns);

/// The memory that such a factor takes, in float64, with its analysis, its workspaces and the
/// assembled matrix; bytes.
double forecast_factor_bytes(double unknowns);

}  // namespace ibmfair
