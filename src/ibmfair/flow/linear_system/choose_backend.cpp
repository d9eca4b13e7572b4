#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// The memory that the backend needs, which does not depend on the number of iterations.
double bytes_of(const JacobianBackend& backend, const JacobianShape& shape) {
  return backend.forecast(shape, {}).bytes;
}

bool fits(double bytes, const FlowOptions& options) {
  const bool allowed =
      std::isinf(options.memory_limit) || resident_bytes() + bytes <= options.memory_limit;
  return allowed && is_available(bytes);
}

[[noreturn]] void refuse(const JacobianBackend& wanted, const JacobianShape& shape) {
  constexpr double mega = 1e6;
  const double limit = std::min(shape.options.memory_limit, resident_bytes() + available_bytes());
  std::string message = fmt::format(
      "with the solver {1} the program needs {0:.0f} MB of memory, of which {2:.0f} MB are in use "
      "already; the limit is {3:.0f} MB (--memory, or what is available)",
      (resident_bytes() + bytes_of(wanted, shape)) / mega, wanted.name, resident_bytes() / mega,
      limit / mega);
  for (const JacobianBackend& other : jacobian_backends()) {
    if (fits(bytes_of(other, shape), shape.options)) {
      message += fmt::format("; --solver {} fits", other.name);
    }
  }
  throw OutOfMemory(message);
}

}  // namespace

const JacobianBackend& choose_backend(const JacobianShape& shape, const JacobianParts& parts) {
  const bool open = shape.options.solver == "auto";
  if (!open || !shape.options.guarded) {
    const JacobianBackend& named =
        open ? backend_as_published() : jacobian_backend(shape.options.solver);
    if (!fits(bytes_of(named, shape), shape.options)) {
      refuse(named, shape);
    }
    return named;
  }
  const IterationForecast iterations = forecast_iterations(shape, parts);
  const JacobianBackend* best = nullptr;
  const JacobianBackend* smallest = &jacobian_backends().front();
  double least_seconds = 0, least_bytes = std::numeric_limits<double>::infinity();
  for (const JacobianBackend& backend : jacobian_backends()) {
    const SolverForecast forecast = backend.forecast(shape, iterations);
    const double seconds = (backend.has_factor ? 1 : tuning.solver.doubt) * forecast.seconds;
    if (fits(forecast.bytes, shape.options) && (best == nullptr || seconds < least_seconds)) {
      best = &backend;
      least_seconds = seconds;
    }
    if (forecast.bytes < least_bytes) {
      smallest = &backend;
      least_bytes = forecast.bytes;
    }
  }
  if (best == nullptr) {
    refuse(*smallest, shape);
  }
  return *best;
}

const JacobianBackend* other_backend(const JacobianShape& shape, bool has_factor) {
  if (shape.options.solver != "auto" || !shape.options.guarded) {
    return nullptr;
  }
  for (const JacobianBackend& backend : jacobian_backends()) {
    if (backend.has_factor == has_factor && fits(bytes_of(backend, shape), shape.options)) {
      return &backend;
    }
  }
  return nullptr;
}

}  // namespace ibmfair
