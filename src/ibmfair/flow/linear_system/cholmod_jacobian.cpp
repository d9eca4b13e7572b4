#include "ibmfair/flow/linear_system/cholmod_jacobian.h"

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
SolverForecast forecast_cholmod(const JacobianShape& shape, const IterationForecast& iterations) {
  return forecast_factor(tuning.solver.cholmod, shape, iterations);
}

CholmodJacobian::CholmodJacobian(const JacobianShape& shape) : shape_(shape), J_(shape) {}

void CholmodJacobian::update(const JacobianParts& parts) {
  J_.update(parts);
  if (!cholesky_) {
    shape_.tell(FlowStage::analyse);
    const Stopwatch watch(shape_.report.seconds.analyse);
    cholesky_.emplace(J_.matrix(), shape_.start(shape_.unknowns.vertex, Eigen::all));
    shape_.report.forecast = cholesky_->forecast();
  }
  shape_.tell(FlowStage::factor);
  const Stopwatch watch(shape_.report.seconds.factor);
  ++shape_.report.factorizations;
  cholesky_->factor(J_.matrix());
}

void CholmodJacobian::solve(const Points& B, Points& Y) {
  shape_.tell(FlowStage::solve);
  const Stopwatch watch(shape_.report.seconds.solve);
  cholesky_->solve(B, Y);
}

}  // namespace ibmfair
