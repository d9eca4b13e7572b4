#include "ibmfair/flow/willmore_flow.h"

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/flow_passes.h"
#include "ibmfair/flow/passes/local_mesh.h"
#include "ibmfair/flow/short_cutoff.h"

namespace ibmfair {
namespace {

FlowReport flow_as_numbered(Points& X, const Topology& topology,
                            const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                            const StepObserver& observer, const MeshParts& parts) {
  const auto gentle = short_cutoff_options(X, topology, options, parts);
  FlowProblem problem(X, topology, fixed, gentle ? *gentle : options, parts);
  if (problem.report.unknowns > 0) {
    run_passes(problem, observer);
    X.swap(problem.X);
  }
  return std::move(problem.report);
}

FlowForecast forecast_as_numbered(const Points& X, const Topology& topology,
                                  const std::vector<std::uint8_t>& fixed,
                                  const FlowOptions& options) {
  FlowProblem problem(X, topology, fixed, options);
  FlowForecast forecast;
  forecast.unknowns = problem.unknowns.size();
  if (forecast.unknowns > 0) {
    forecast.backends = problem.jacobian().forecasts(X, options.total_time / options.steps);
    forecast.solver = problem.report.solver;
  }
  return forecast;
}

}  // namespace

FlowReport willmore_flow(Points& X, const Topology& topology,
                         const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                         const StepObserver& observer, const MeshParts& parts) {
  FlowReport report;
  double seconds = 0;
  {
    const Stopwatch watch(seconds);
    require_usable(X, fixed, options, parts);
    if (parts.is_whole() && is_scattered(topology)) {
      LocalMesh local = local_mesh(X, topology, fixed, options);
      report =
          flow_as_numbered(local.X, local.topology, local.fixed, local.options, observer, parts);
      X(local.vertex, Eigen::all) = local.X;
    } else {
      report = flow_as_numbered(X, topology, fixed, options, observer, parts);
    }
  }
  report.seconds.other = seconds - report.seconds.named();
  return report;
}

FlowForecast forecast_flow(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options) {
  require_usable(X, fixed, options);
  if (!is_scattered(topology)) {
    return forecast_as_numbered(X, topology, fixed, options);
  }
  const LocalMesh local = local_mesh(X, topology, fixed, options);
  return forecast_as_numbered(local.X, local.topology, local.fixed, local.options);
}

}  // namespace ibmfair
