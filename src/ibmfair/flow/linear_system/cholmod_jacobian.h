// The Jacobian as a sparse matrix, factored by CHOLMOD.
#pragma once

#include <optional>

#include "ibmfair/flow/linear_system/assembled_jacobian.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/solve/cholmod_cholesky.h"

namespace ibmfair {

/// One analysis, one factorization for each update, one solve for each step, all in float64, as
/// [W07] section 3.2 describes it with another package (PARDISO).
class CholmodJacobian final : public JacobianSolver {
 public:
  explicit CholmodJacobian(const JacobianShape& shape);

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;

 private:
  const JacobianShape shape_;
  AssembledJacobian J_;
  std::optional<CholmodCholesky> cholesky_;
};

/// The predicted cost of a CholmodJacobian.
SolverForecast forecast_cholmod(const JacobianShape& shape, const IterationForecast& iterations);

}  // namespace ibmfair
