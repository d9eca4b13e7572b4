#include "ibmfair/flow/iterative_jacobian.h"

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"

namespace ibmfair {
namespace {

constexpr double tolerance = 1e-2;  // of the residual; a tenth of it changes no result visibly
constexpr int most_iterations = 1000;

}  // namespace

IterativeJacobian::IterativeJacobian(const JacobianShape& shape)
    : shape_(shape), operator_(shape.stencils, shape.unknowns), solver_(operator_) {}

void IterativeJacobian::update(const JacobianParts& parts) {
  if (parts.directions != nullptr) {
    throw BadOption("conjugate gradients do not solve stationary problems");
  }
  const Stopwatch watch(shape_.report.seconds.assemble);
  operator_.update(parts.weights, parts.D, parts.h);
}

void IterativeJacobian::solve(const Points& B, Points& Y) {
  const Stopwatch watch(shape_.report.seconds.solve);
  shape_.report.iterations += solver_.solve(B, Y, tolerance, most_iterations);
}

}  // namespace ibmfair
