#include "ibmfair/flow/direct_jacobian.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"

namespace ibmfair {
namespace {

/// The largest relative residual of a solve. Refining once would leave its square.
constexpr double good_enough = 1e-3;

/// Where an entry of diag(J) is more than this times that of D, float32 would lose D next to it.
constexpr double widest_float32 = 1e6;

/// |B - J Y| / |B| in the norm of D^-1, D being the diagonal of J: every row counts alike, however
/// small its triangles are.
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

}  // namespace

DirectJacobian::DirectJacobian(const JacobianShape& shape)
    : shape_(shape), assembler_(shape.stencils, shape.unknowns), J_(assembler_.pattern()) {}

void DirectJacobian::update(const JacobianParts& parts) {
  {
    const Stopwatch watch(shape_.report.seconds.assemble);
    assemble(parts);
  }
  if (!symbolic_) {
    const Stopwatch watch(shape_.report.seconds.analyse);
    symbolic_.emplace(J_, shape_.options.ordering);
    shape_.report.forecast = symbolic_->forecast();
  }
  double widest = 0;
  for (Index u = 0; u < J_.size(); ++u) {
    widest = std::max(widest, J_.value[J_.column_first[u]] / parts.D[u]);
  }
  factor(needs_float64_ || !(widest <= widest_float32) ? Precision::float64 : Precision::float32);
}

void DirectJacobian::assemble(const JacobianParts& parts) {
  assembler_.assemble(parts.weights, J_);
  parallel_for(J_.size(), [&](std::int64_t j) {
    const std::int64_t diagonal = J_.column_first[j];
    for (std::int64_t k = diagonal; k < J_.column_first[j + 1]; ++k) {
      J_.value[k] *= parts.h;
      // Where a direction is zero, the diagonal keeps J definite.
      if (parts.directions != nullptr && k > diagonal) {
        J_.value[k] *= parts.directions->row(j).dot(parts.directions->row(J_.row[k]));
      }
    }
    J_.value[diagonal] += parts.D[j];
  });
}

void DirectJacobian::factor(Precision precision) {
  const Stopwatch watch(shape_.report.seconds.factor);
  if (!factor_ || precision != precision_) {
    precision_ = precision;
    solver_.reset();  // refers to the factor
    factor_.emplace(*symbolic_, precision);
    solver_.emplace(*factor_);
  }
  ++shape_.report.factorizations;
  tried_ = precision == Precision::float64;
  try {
    factor_->factor(J_);
  } catch (const FactorizationFailed&) {
    if (precision == Precision::float64) throw;
    needs_float64_ = true;
    factor(Precision::float64);
  }
}

void DirectJacobian::solve(const Points& B, Points& Y) {
  Points solution;
  {
    const Stopwatch watch(shape_.report.seconds.solve);
    solver_->solve(B, solution);
    tried_ = tried_ || relative_residual(J_, solution, B) < good_enough;
  }
  if (tried_) {
    Y.swap(solution);
  } else {
    needs_float64_ = true;
    factor(Precision::float64);
    solve(B, Y);
  }
}

}  // namespace ibmfair
