#include "ibmfair/flow/flow_passes.h"

#include <cmath>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/first_stage.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/flow/passes/clean_up.h"
#include "ibmfair/flow/passes/residual_spikes.h"
#include "ibmfair/flow/passes/restored_quantities.h"
#include "ibmfair/flow/passes/twicing.h"
#include "ibmfair/flow/steps/guarded_flow.h"
#include "ibmfair/flow/steps/plain_flow.h"

namespace ibmfair {

void run_passes(FlowProblem& problem, const StepObserver& observer) {
  const FlowOptions& options = problem.options;
  FlowReport& report = problem.report;
  const auto goes_on = [&] { return report.status == FlowStatus::completed; };
  const CompressedRows rings = options.guarded ? vertex_rings(problem.topology) : CompressedRows();

  const std::optional<FlowReport> first = run_first_stage(problem, rings, observer);
  if (goes_on()) run_time_steps(problem, rings, observer);
  if (goes_on() && options.clean_up && first) flatten_residual_spikes(problem, rings);
  if (goes_on() && options.twicing > 0) apply_twicing(problem);
  if (problem.quantities_are_suspended() && report.solves > 0) restore_quantities(problem);
  if (first) report.add_effort(*first);
}

void run_time_steps(FlowProblem& problem, const CompressedRows& rings,
                    const StepObserver& observer) {
  if (!problem.options.guarded) {
    run_plain(problem, observer);
    return;
  }
  const FoldWatch folds(problem.X, problem.topology);
  const Eigen::VectorXd missed = run_guarded(problem, rings, folds, observer);
  if (problem.options.clean_up) clean_up(problem, rings, folds, missed);
}

std::optional<FlowReport> run_first_stage(FlowProblem& problem, const CompressedRows& rings,
                                          const StepObserver& observer) {
  const auto options = first_stage_options(problem);
  if (!options) {
    return std::nullopt;
  }
  FlowProblem stage(problem.start(), problem.topology, problem.fixed, *options, problem.parts);
  const bool filters = options->first_stage == FirstStage::normals;
  if (filters) {
    filter_normals(stage);
  }
  // A flow that relaxes in its first stage only needs the steps of that stage.
  if (!filters || (options->relax && !problem.options.relax)) {
    const FoldWatch folds(stage.X, stage.topology);
    run_guarded(stage, rings, folds, [&](StepRecord record) {
      record.step = 0;
      record.time = 0;
      return !observer || observer(record);
    });
  }
  problem.move_to(stage.X);
  problem.update_gradient();
  if (problem.energy() > problem.report.energy_before) {
    problem.move_to(stage.X);
    problem.update_gradient();
  }
  problem.report.energy_after = problem.energy();
  if (stage.report.status == FlowStatus::interrupted) {
    problem.report.status = FlowStatus::interrupted;
  }
  return std::move(stage.report);
}

void require_usable(const Points& X, const std::vector<std::uint8_t>& fixed,
                    const FlowOptions& options, const MeshParts& parts) {
  options.validate();
  if (options.solver != "auto") {
    jacobian_backend(options.solver);
  }
  if (!parts.is_whole() && (options.keep_volume || options.keep_area)) {
    throw BadOption(
        "--keep-volume and --keep-area need the whole mesh in one process, so they cannot be "
        "combined with --engine petsc");
  }
  if (!parts.is_whole() && options.first_stage == FirstStage::normals) {
    throw BadOption("--first-stage normals needs the whole mesh in one process");
  }
  const Eigen::VectorXd& factor = options.cutoff_factor;
  if (factor.size() > 0 && factor.size() != X.rows()) {
    throw BadOption("there must be a weight for every vertex");
  }
  for (Eigen::Index v = 0; v < factor.size(); ++v) {
    if (!fixed[v] && !(factor[v] > 0 && std::isfinite(factor[v]))) {
      throw BadOption("the weights of moving vertices must be positive and finite");
    }
  }
  if (!X.allFinite()) {
    throw BadMesh("a coordinate is not finite");
  }
}

}  // namespace ibmfair
