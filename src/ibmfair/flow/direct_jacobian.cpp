#include "ibmfair/flow/direct_jacobian.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"

namespace ibmfair {
namespace {

/// The largest relative residual of a solve. Refining once would leave its square.
constexpr double good_enough = 1e-3;

/// Who asks for a smaller residual than this gets a factor in float64.
constexpr double float32_tolerance = 1e-4;

// Seconds on one core of a machine of 2023; only their ratios matter. tools/solver_table prints
// what they were chosen by, here and in iterative_jacobian.cpp.
constexpr double per_flop = 1 / 52e9;   // of the factorization, float32
constexpr double per_entry = 8 / 16e9;  // of the factor, read twice in each solve

// Factorizations by all steps of the guarded flow. The farther smoothing reaches, the more of the
// noise it takes away, which the Jacobian was made with.
double factorizations(double iterations) {
  return std::clamp(iterations / 15, 1.0, 6.0);
}

// Bytes, as seen on tori of 41 and 164 thousand vertices: the analysis and the assembled matrix,
// and the factor, which may have to be float64, with what factoring it needs.
constexpr double bytes_per_unknown = 1630, bytes_per_entry = 8.5;

// The order of elimination, which all cores share, and the symbolic factorization, during which
// all but one wait: counted as on two, as the choice must not depend on how many there are.
double analysis_seconds(double n) {
  return 2.2e-6 * n;
}

// Surfaces have small separators: nested dissection leaves about this much.
double factor_entries(double n) {
  return 9 * n * std::log2(n + 2);
}
double factor_flops(double n) {
  return 250 * std::pow(n, 1.5);
}

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

/// Whether float32 would round off of a row of J, or add to it, more of D than belongs to the part
/// of the surface around it that moves as one: J might no longer be positive there. That part has
/// as many vertices as the square of the length that is smoothed over, the cut-off, which the
/// fourth root of diag(J) / D is proportional to at most of the vertices.
bool is_too_wide_for_float32(const SymmetricMatrix& J, const Eigen::VectorXd& D) {
  constexpr double widest = 1 << 24;  // of which D is less than the last digit
  std::vector<double> ratio(static_cast<std::size_t>(J.size()));
  double largest = 0;
  for (Index u = 0; u < J.size(); ++u) {
    ratio[u] = J.value[J.column_first[u]] / D[u];
    largest = std::max(largest, ratio[u]);
  }
  if (largest <= widest) {
    return false;
  }
  const auto middle = ratio.begin() + J.size() / 2;
  std::nth_element(ratio.begin(), middle, ratio.end());
  return !(largest <= widest * std::sqrt(*middle));
}

void tell_stage(const FlowOptions& options, FlowStage stage) {
  if (options.on_stage) {
    options.on_stage(stage);
  }
}

}  // namespace

SolverForecast forecast_direct(const JacobianShape& shape, const IterationForecast& iterations) {
  const double n = shape.unknowns.size(), entries = factor_entries(n);
  const double left = shape.solves_left();
  const double factors =
      shape.options.guarded
          ? std::max(1.0, factorizations(iterations.of_cutoff) * left / shape.options.steps)
          : 1;
  return {.seconds = analysis_seconds(n) + per_flop * factor_flops(n) * factors +
                     per_entry * entries * left,
          .bytes = bytes_per_unknown * n + bytes_per_entry * entries,
          .factor_entries = entries};
}

DirectJacobian::DirectJacobian(const JacobianShape& shape)
    : shape_(shape),
      assembler_(shape.terms, shape.unknowns),
      J_(assembler_.pattern()),
      needs_float64_(shape.options.solver_tolerance < float32_tolerance) {}

void DirectJacobian::update(const JacobianParts& parts) {
  {
    const Stopwatch watch(shape_.report.seconds.assemble);
    assemble(parts);
  }
  if (!symbolic_) {
    tell_stage(shape_.options, FlowStage::analyse);
    const Stopwatch watch(shape_.report.seconds.analyse);
    symbolic_.emplace(J_, shape_.start(shape_.unknowns.vertex, Eigen::all));
    shape_.report.forecast = symbolic_->forecast();
  }
  const bool wide = needs_float64_ || is_too_wide_for_float32(J_, parts.D);
  factor(wide ? Precision::float64 : Precision::float32);
}

void DirectJacobian::assemble(const JacobianParts& parts) {
  assembler_.assemble(parts.weights, J_);
  parallel_for(J_.size(), [&](std::int64_t j) {
    const std::int64_t diagonal = J_.column_first[j];
    for (std::int64_t k = diagonal; k < J_.column_first[j + 1]; ++k) {
      J_.value[k] *= parts.h;
    }
    J_.value[diagonal] += parts.D[j];
  });
}

void DirectJacobian::factor(Precision precision) {
  tell_stage(shape_.options, FlowStage::factor);
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
  tell_stage(shape_.options, FlowStage::solve);
  {
    const Stopwatch watch(shape_.report.seconds.solve);
    solver_->solve(B, Y);
    tried_ = tried_ || relative_residual(J_, Y, B) < good_enough;
  }
  if (!tried_) {
    needs_float64_ = true;
    factor(Precision::float64);
    solve(B, Y);
  }
}

}  // namespace ibmfair
