#include "ibmfair/base/errors.h"
#include "ibmfair/base/named_row.h"
#include "ibmfair/base/stopwatch.h"
#ifdef IBMFAIR_CHOLMOD_LIBRARY
#include "ibmfair/flow/linear_system/cholmod_jacobian.h"
#include "ibmfair/solve/cholmod_library.h"
#endif
#include "ibmfair/flow/linear_system/iterative_jacobian.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/flow/linear_system/multifrontal_jacobian.h"

namespace ibmfair {
namespace {

template <class Solver>
std::unique_ptr<JacobianSolver> make(const JacobianShape& shape) {
  const Stopwatch watch(shape.report.seconds.assemble);  // finds the pattern
  return std::make_unique<Solver>(shape);
}

constexpr JacobianBackend backends[] = {
    {"multifrontal", "one factorization for many steps", make<MultifrontalJacobian>,
     forecast_multifrontal, true},
    {"cg", "conjugate gradients, least memory", make<IterativeJacobian>, forecast_iterative, false},
#ifdef IBMFAIR_CHOLMOD_LIBRARY
    {"cholmod",
     "factorization by the package CHOLMOD, slower; in double precision it gives the same as "
     "multifrontal to 1e-12",
     make<CholmodJacobian>, forecast_cholmod, true, cholmod_components},
#endif
};

}  // namespace

bool JacobianBackend::is_present() const {
  try {
    if (load != nullptr) load();
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::span<const JacobianBackend> jacobian_backends() {
  return backends;
}

const JacobianBackend& jacobian_backend(std::string_view name) {
  return row_named(jacobian_backends(), "solver", name);
}

const JacobianBackend& backend_as_published() {
  const JacobianBackend* best = &jacobian_backend("multifrontal");
  for (const JacobianBackend& backend : backends) {
    if (backend.name == "cholmod" && backend.is_present()) best = &backend;
  }
  return *best;
}

}  // namespace ibmfair
