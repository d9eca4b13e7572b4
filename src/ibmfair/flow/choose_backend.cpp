#include <algorithm>
#include <cmath>

#include "ibmfair/flow/jacobian_solver.h"

namespace ibmfair {
namespace {

// Seconds on one core of a machine of 2023; only their ratios matter. tools/solver_table prints
// what they were chosen by.
constexpr double ordering_per_unknown = 4.5e-6;
constexpr double per_flop = 1 / 25e9;    // of the factorization, float32
constexpr double per_entry = 8 / 5e9;    // of the factor, read twice in each solve
constexpr double per_place = 5.5e-9;     // of the stencils, in each iteration
constexpr double steps_per_renewal = 4;  // of the guarded flow

// Surfaces have small separators: nested dissection leaves about this much.
double factor_entries(double n) {
  return 10 * n * std::log2(n + 2);
}
double factor_flops(double n) {
  return 300 * std::pow(n, 1.5);
}

/// Iterations for a part in a hundred, by the mean of diag(J) / D: the square root of a condition
/// number, with the factor that was measured on smooth and noisy meshes.
double iterations(const JacobianShape& shape, const JacobianParts& parts) {
  double ratio = 0;  // of h diag(S) to D
  for (Index s = 0; s < shape.stencils.size(); ++s) {
    for (std::int64_t k = shape.stencils.first[s]; k < shape.stencils.first[s + 1]; ++k) {
      const Index u = shape.unknowns.unknown[shape.stencils.value[k]];
      const double c = parts.weights.c[k];
      ratio += u >= 0 ? parts.h * parts.weights.w[s] * c * c / parts.D[u] : 0;
    }
  }
  return 9.5 * std::sqrt(1 + ratio / std::max<Index>(1, shape.unknowns.size()));
}

}  // namespace

std::string_view cheaper_backend(const JacobianShape& shape, const JacobianParts& parts) {
  if (parts.directions != nullptr) {
    return "cholmod";
  }
  const double n = shape.unknowns.size(), steps = shape.options.steps;
  const double factored = ordering_per_unknown * n +
                          per_flop * factor_flops(n) * std::ceil(steps / steps_per_renewal) +
                          per_entry * factor_entries(n) * steps;
  const double iterated = per_place * static_cast<double>(shape.stencils.value.size()) *
                          iterations(shape, parts) * steps;
  return iterated < factored ? "cg" : "cholmod";
}

}  // namespace ibmfair
