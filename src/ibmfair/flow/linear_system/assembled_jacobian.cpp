#include "ibmfair/flow/linear_system/assembled_jacobian.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"

namespace ibmfair {

AssembledJacobian::AssembledJacobian(const JacobianShape& shape)
    : report_(shape.report), assembler_(shape.terms, shape.unknowns), J_(assembler_.pattern()) {}

void AssembledJacobian::update(const JacobianParts& parts) {
  const Stopwatch watch(report_.seconds.assemble);
  assembler_.assemble(parts.weights, J_);
  parallel_for(J_.size(), [&](std::int64_t j) {
    const std::int64_t diagonal = J_.column_first[j];
    for (std::int64_t k = diagonal; k < J_.column_first[j + 1]; ++k) {
      J_.value[k] *= parts.h;
    }
    J_.value[diagonal] += parts.D[j];
  });
}

double forecast_factorizations(const JacobianShape& shape, const IterationForecast& iterations) {
  if (!shape.options.guarded) return 1;
  // The number in all steps of the guarded flow grows with the cut-off: the more of the noise is
  // removed, the more the mesh differs from the one that the Jacobian was built on.
  const double in_all_steps = std::clamp(iterations.of_cutoff / 15, 1.0, 6.0);
  return std::max(1.0, in_all_steps * shape.solves_left() / shape.options.steps);
}

double forecast_factor_entries(double unknowns) {
  return 9 * unknowns * std::log2(unknowns + 2);
}

double forecast_factor_flops(double unknowns) {
  return 250 * std::pow(unknowns, 1.5);
}

double forecast_factor_bytes(double unknowns) {
  // As measured on tori of 41 and 164 thousand vertices. Per unknown: the analysis and the
  // assembled matrix. Per entry: the triangular factor with the workspace of the factorization.
  constexpr double per_unknown = 1630, per_entry = 8.5;
  return per_unknown * unknowns + per_entry * forecast_factor_entries(unknowns);
}

}  // namespace ibmfair
