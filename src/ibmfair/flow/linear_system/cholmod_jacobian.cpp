#include "ibmfair/flow/linear_system/cholmod_jacobian.h"

#include "ibmfair/base/stopwatch.h"

namespace ibmfair {
namespace {

// Seconds as in multifrontal_jacobian.cpp, measured beside them by tools/solver_table.
constexpr double per_unknown = 2.2e-6;  // of the analysis
constexpr double per_flop = 1 / 16e9;
constexpr double per_entry = 8 / 3.2e9;  // read twice per solve

// Otherwise the memory is that of multifrontal_jacobian.cpp in float64 (tools/solver_table).
constexpr double bytes_of_libraries = 4e6;

}  // namespace

SolverForecast forecast_cholmod(const JacobianShape& shape, const IterationForecast& iterations) {
  const double n = shape.unknowns.size(), entries = forecast_factor_entries(n);
  return {
      .seconds = per_unknown * n +
                 per_flop * forecast_factor_flops(n) * forecast_factorizations(shape, iterations) +
                 per_entry * entries * shape.solves_left(),
      .bytes = bytes_of_libraries + forecast_factor_bytes(n),
      .factor_entries = entries};
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
