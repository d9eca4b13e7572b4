#include "ibmfair/flow/willmore_flow.h"

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/guarded_flow.h"
#include "ibmfair/flow/plain_flow.h"

namespace ibmfair {

FlowReport willmore_flow(Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
                         const FlowOptions& options, const StepObserver& observer) {
  options.validate();
  if (!X.allFinite()) {
    throw BadMesh("a coordinate is not finite");
  }
  FlowProblem problem(X, topology, held, options);
  if (problem.unknowns.size() > 0) {
    (options.guarded ? run_guarded : run_plain)(problem, observer);
    X.swap(problem.X);
  }
  return std::move(problem.report);
}

}  // namespace ibmfair
