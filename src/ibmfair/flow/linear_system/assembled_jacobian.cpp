#include "ibmfair/flow/linear_system/assembled_jacobian.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// The number of numeric factorizations in the remaining steps.
double forecast_factorizations(const JacobianShape& shape, const IterationForecast& iterations) {
  if (!shape.options.guarded) return 1;
  const double in_all_steps =
      std::clamp(iterations.of_cutoff / tuning.solver.iterations_per_factorization, 1.0,
                 tuning.solver.most_factorizations);
  return std::max(1.0, in_all_steps * shape.solves_left() / shape.options.steps);
}

}  // namespace

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

SolverForecast forecast_factor(const SolverTuning::Factorization& costs, const JacobianShape& shape,
                               const IterationForecast& iterations) {
  const double n = shape.unknowns.size();
  const double entries = tuning.solver.factor_entries * n * std::log2(n + 2);
  const double flops = tuning.solver.factor_flops * std::pow(n, 1.5);
  return {.seconds = costs.analysis * n +
                     costs.flop * flops * forecast_factorizations(shape, iterations) +
                     costs.entry * entries * shape.solves_left(),
          .bytes = costs.library_bytes + tuning.solver.bytes_per_unknown * n +
                   tuning.solver.bytes_per_entry * entries,
          .factor_entries = entries};
}

}  // namespace ibmfair
