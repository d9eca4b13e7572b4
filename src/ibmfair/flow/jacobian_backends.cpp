#include <string>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/iterative_jacobian.h"
#include "ibmfair/flow/jacobian_solver.h"
#include "ibmfair/flow/multifrontal_jacobian.h"

namespace ibmfair {
namespace {

template <class Solver>
std::unique_ptr<JacobianSolver> make(const JacobianShape& shape) {
  const Stopwatch watch(shape.report.seconds.assemble);  // finds the pattern
  return std::make_unique<Solver>(shape);
}

constexpr JacobianBackend backends[] = {
    {"cholmod", "factored once, by CHOLMOD's analysis", make<MultifrontalJacobian>,
     forecast_multifrontal, true},
    {"cg", "conjugate gradients without a factor: least memory", make<IterativeJacobian>,
     forecast_iterative, false},
};

}  // namespace

std::span<const JacobianBackend> jacobian_backends() {
  return backends;
}

const JacobianBackend& jacobian_backend(std::string_view name) {
  std::string names;
  for (const JacobianBackend& backend : backends) {
    if (backend.name == name) {
      return backend;
    }
    names += std::string(names.empty() ? "" : ", ") + std::string(backend.name);
  }
  throw BadOption("there is no solver '" + std::string(name) + "'; there are auto, " + names);
}

}  // namespace ibmfair
