#include "ibmfair/flow/linear_system/multifrontal_jacobian.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/quantile.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// |B - J Y| / |B| in the norm of D^-1, with D the diagonal of J, so that every row counts alike,
/// even if its triangles are small.
double relative_residual(const SymmetricMatrix& J, const Points& Y, const Points& B) {
  const Points R = B - multiply(J, Y);
  double residual = 0, size = 0;
  for (Index i = 0; i < R.rows(); ++i) {
    const double diagonal = J.value[J.column_first[i]];
    residual += R.row(i).squaredNorm() / diagonal;
    size += B.row(i).squaredNorm() / diagonal;
  }
  return size > 0 ? std::sqrt(residual / size) : 0;
}

/// Whether rounding a row of J to float32 may change the row by more than the sum of D over the
/// vertices around it that move together; J might then no longer be positive definite. The number
/// of these vertices is the square of the cut-off in edge lengths, and at most vertices the fourth
/// root of diag(J) / D is proportional to the cut-off.
bool is_too_wide_for_float32(const SymmetricMatrix& J, const Eigen::VectorXd& D) {
  constexpr double widest = 1 << 24;  // exact: beyond, D is below the last digit of J
  std::vector<double> ratio(static_cast<std::size_t>(J.size()));
  double largest = 0;
  for (Index u = 0; u < J.size(); ++u) {
    ratio[u] = J.value[J.column_first[u]] / D[u];
    largest = std::max(largest, ratio[u]);
  }
  if (largest <= widest) {
    return false;
  }
  return !(largest <= widest * std::sqrt(median(ratio)));
}

}  // namespace

SolverForecast forecast_multifrontal(const JacobianShape& shape,
                                     const IterationForecast& iterations) {
  return forecast_factor(tuning.solver.multifrontal, shape, iterations);
}

MultifrontalJacobian::MultifrontalJacobian(const JacobianShape& shape)
    : shape_(shape),
      J_(shape),
      needs_float64_(shape.options.solver_tolerance < tuning.solver.float32_tolerance) {}

void MultifrontalJacobian::update(const JacobianParts& parts) {
  J_.update(parts);
  if (!analysis_) {
    shape_.tell(FlowStage::analyse);
    const Stopwatch watch(shape_.report.seconds.analyse);
    analysis_.emplace(J_.matrix(), shape_.start(shape_.unknowns.vertex, Eigen::all));
    shape_.report.forecast = analysis_->forecast();
  }
  const bool wide = needs_float64_ || is_too_wide_for_float32(J_.matrix(), parts.D);
  factor(wide ? Precision::float64 : Precision::float32);
}

void MultifrontalJacobian::factor(Precision precision) {
  shape_.tell(FlowStage::factor);
  const Stopwatch watch(shape_.report.seconds.factor);
  if (!cholesky_ || precision != precision_) {
    precision_ = precision;
    cholesky_.emplace(*analysis_, precision);
  }
  ++shape_.report.factorizations;
  tried_ = precision == Precision::float64;
  try {
    cholesky_->factor(J_.matrix());
  } catch (const FactorizationFailed&) {
    if (precision == Precision::float64) throw;
    needs_float64_ = true;
    factor(Precision::float64);
  }
}

void MultifrontalJacobian::solve(const Points& B, Points& Y) {
  shape_.tell(FlowStage::solve);
  {
    const Stopwatch watch(shape_.report.seconds.solve);
    cholesky_->solve(B, Y);
    tried_ = tried_ || relative_residual(J_.matrix(), Y, B) < tuning.solver.float32_residual;
  }
  if (!tried_) {
    needs_float64_ = true;
    factor(Precision::float64);
    solve(B, Y);
  }
}

}  // namespace ibmfair
