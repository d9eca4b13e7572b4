#include <algorithm>
#include <cmath>
#include <vector>

#include "ibmfair/flow/jacobian_solver.h"

namespace ibmfair {
namespace {

// Seconds on one core of a machine of 2023; only their ratios matter. tools/solver_table prints
// what they were chosen by.
constexpr double ordering_per_unknown = 5.5e-6;
constexpr double per_flop = 1 / 20e9;  // of the factorization, float32
constexpr double per_entry = 8 / 5e9;  // of the factor, read twice in each solve
constexpr double per_place = 2.7e-9;   // of the stencils, in each iteration
constexpr double renewals = 5;         // of the guarded flow, where the mesh is noisy

// Surfaces have small separators: nested dissection leaves about this much.
double factor_entries(double n) {
  return 10 * n * std::log2(n + 2);
}
double factor_flops(double n) {
  return 300 * std::pow(n, 1.5);
}

/// Iterations to the default tolerance: a square root of a condition number,
/// which the larger ones of diag(J) / D make. The largest of all belong to needles, of which there
/// are few, or which a noisy mesh has for the first steps only. Within a third of what was counted
/// on tori, noisy and not, and on eleven models.
double iterations(const JacobianShape& shape, const JacobianParts& parts) {
  std::vector<double> ratio(static_cast<std::size_t>(shape.unknowns.size()), 0);  // h diag(S) / D
  for (Index s = 0; s < shape.stencils.size(); ++s) {
    for (std::int64_t k = shape.stencils.first[s]; k < shape.stencils.first[s + 1]; ++k) {
      if (const Index u = shape.unknowns.unknown[shape.stencils.value[k]]; u >= 0) {
        const double c = parts.weights.c[k];
        ratio[u] += parts.h * parts.weights.w[s] * c * c / parts.D[u];
      }
    }
  }
  const auto large = ratio.begin() + static_cast<std::ptrdiff_t>(0.9 * ratio.size());
  std::nth_element(ratio.begin(), large, ratio.end());
  return 3.2 * std::sqrt(1 + (ratio.empty() ? 0 : *large));
}

}  // namespace

std::string_view cheaper_backend(const JacobianShape& shape, const JacobianParts& parts) {
  if (parts.directions != nullptr || !shape.options.guarded) {  // the scheme as published factors
    return "cholmod";
  }
  const double n = shape.unknowns.size(), steps = shape.options.steps;
  const double factored = ordering_per_unknown * n + per_flop * factor_flops(n) * renewals +
                          per_entry * factor_entries(n) * steps;
  const double iterated = per_place * static_cast<double>(shape.stencils.value.size()) *
                          iterations(shape, parts) * steps;
  return iterated < factored ? "cg" : "cholmod";
}

}  // namespace ibmfair
