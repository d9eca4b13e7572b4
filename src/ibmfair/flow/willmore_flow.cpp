#include "ibmfair/flow/willmore_flow.h"

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/guarded_flow.h"
#include "ibmfair/flow/plain_flow.h"

namespace ibmfair {
namespace {

void require_usable(const Points& X, const FlowOptions& options) {
  options.validate();
  if (!X.allFinite()) {
    throw BadMesh("a coordinate is not finite");
  }
}

}  // namespace

FlowReport willmore_flow(Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
                         const FlowOptions& options, const StepObserver& observer) {
  require_usable(X, options);
  FlowProblem problem(X, topology, held, options);
  if (problem.unknowns.size() > 0) {
    (options.guarded ? run_guarded : run_plain)(problem, observer);
    X.swap(problem.X);
  }
  return std::move(problem.report);
}

FlowForecast forecast_flow(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options) {
  require_usable(X, options);
  FlowProblem problem(X, topology, held, options);
  FlowForecast forecast;
  forecast.unknowns = problem.unknowns.size();
  if (forecast.unknowns > 0) {
    forecast.backends = problem.jacobian().forecasts(X, options.total_time / options.steps);
    forecast.solver = problem.report.solver;
  }
  return forecast;
}

}  // namespace ibmfair
