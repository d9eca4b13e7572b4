#include "ibmfair/flow/iterative_jacobian.h"

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"

namespace ibmfair {
namespace {

constexpr int most_iterations = 1000;

}  // namespace

IterativeJacobian::IterativeJacobian(const JacobianShape& shape)
    : shape_(shape), J_(shape.stencils, shape.unknowns), solver_(J_) {}

void IterativeJacobian::update(const JacobianParts& parts) {
  if (parts.directions != nullptr) {
    throw BadOption("conjugate gradients do not solve stationary problems");
  }
  const Stopwatch watch(shape_.report.seconds.assemble);
  J_.update(parts.weights, parts.D, parts.h);
}

void IterativeJacobian::solve(const Points& B, Points& Y) {
  const Stopwatch watch(shape_.report.seconds.solve);
  shape_.report.iterations += solver_.solve(B, Y, shape_.options.solver_tolerance, most_iterations);
}

}  // namespace ibmfair
