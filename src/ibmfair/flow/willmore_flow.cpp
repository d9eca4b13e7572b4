#include "ibmfair/flow/willmore_flow.h"

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/passes/local_mesh.h"
#include "ibmfair/flow/passes/residual_spikes.h"
#include "ibmfair/flow/passes/twicing.h"
#include "ibmfair/flow/run_flow.h"
#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/fold_free_move.h"
#include "ibmfair/flow/steps/folds.h"

namespace ibmfair {
namespace {

/// Flattens residual spikes and applies twicing after the flow. `took_noise`: a first stage removed
/// noise.
void finish(FlowProblem& problem, bool took_noise) {
  const FlowOptions& options = problem.options;
  if (took_noise && options.clean_up) {
    flatten_residual_spikes(problem);
  }
  if (options.twicing > 0) {
    twice(problem);
  }
}

/// Restores the volume and area that the steps did not keep. If that fails, the result is the
/// start.
void restore_quantities(FlowProblem& problem) {
  FoldWatch folds(problem.X, problem.topology, problem.unknowns);
  Points move = problem.resume_quantities(), Y;
  const FoldFreeLanding trial = displace_without_folds(
      problem, folds, move, Y, [&](const Points& place) { return problem.energy_at(place); });
  FlowReport& report = problem.report;
  if (trial.leads_somewhere() && trial.energy <= report.energy_before) {
    report.energy_after = trial.energy;
  } else {
    Y = problem.start();
    report.energy_after = report.energy_before;
    report.time_reached = 0;
    report.status = FlowStatus::stalled;
  }
  problem.move_to(Y);
}

FlowReport flow_as_numbered(Points& X, const Topology& topology,
                            const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                            const StepObserver& observer, const MeshParts& parts) {
  FlowProblem problem(X, topology, fixed, options, parts);
  if (problem.report.unknowns > 0) {
    const FlowReport first = run_first_stage(problem, fixed, observer);
    if (problem.report.status != FlowStatus::interrupted) {
      run_flow(problem, observer);
    }
    if (problem.report.status == FlowStatus::completed) {
      finish(problem, first.solves > 0);
    }
    if (problem.quantities_are_suspended() && problem.report.solves > 0) {
      restore_quantities(problem);
    }
    problem.report.add_effort(first);
    X.swap(problem.X);
  }
  return std::move(problem.report);
}

/// Renumbers the mesh for the flow if neighbours are far apart in memory.
FlowReport flow_by_places(Points& X, const Topology& topology,
                          const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                          const StepObserver& observer, const MeshParts& parts) {
  if (!parts.is_whole() || !is_scattered(topology)) {
    return flow_as_numbered(X, topology, fixed, options, observer, parts);
  }
  LocalMesh local = local_mesh(X, topology, fixed, options);
  FlowReport report =
      flow_as_numbered(local.X, local.topology, local.fixed, local.options, observer, parts);
  X(local.vertex, Eigen::all) = local.X;
  return report;
}

FlowForecast forecast_as_numbered(const Points& X, const Topology& topology,
                                  const std::vector<std::uint8_t>& fixed,
                                  const FlowOptions& options) {
  FlowProblem problem(X, topology, fixed, options, MeshParts::one());
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
    report = flow_by_places(X, topology, fixed, options, observer, parts);
  }
  report.seconds.other = seconds - report.seconds.named();
  return report;
}

FlowForecast forecast_flow(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options) {
  require_usable(X, fixed, options, MeshParts::one());
  if (!is_scattered(topology)) {
    return forecast_as_numbered(X, topology, fixed, options);
  }
  const LocalMesh local = local_mesh(X, topology, fixed, options);
  return forecast_as_numbered(local.X, local.topology, local.fixed, local.options);
}

}  // namespace ibmfair
