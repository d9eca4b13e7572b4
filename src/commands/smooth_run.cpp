#include "commands/smooth_run.h"

#include "ibmfair/flow/passes/meeting_lines.h"
#include "ibmfair/flow/passes/restored_rims.h"
#include "ibmfair/flow/passes/restored_walls.h"

namespace ibmfair::commands {

std::vector<std::uint8_t> prepare_for_flow(const SmoothPlan& plan, const Topology& topology,
                                           Points& X) {
  if (!plan.lines.empty()) {
    fair_meeting_lines(plan.lines, topology, plan.cutoff, plan.line_factor, plan.flow.max_move, X);
  }
  if (!plan.rims) {
    return plan.fixed;
  }
  const std::vector<std::uint8_t> with_curves = fair_rims(X, topology, plan.fixed, *plan.rims);
  // Where a crease ends at a rim, the curve is blunter than the crease that the flow keeps.
  return plan.flow.sharp_angle > 0 ? plan.fixed : with_curves;
}

FlowReport run_smoothing(const SmoothPlan& plan, Points& X, const Topology& topology,
                         const MeshParts& parts, const std::function<bool()>& wants_end,
                         Progress& progress) {
  plan.outliers.move_in(X);
  if (plan.flow.steps == 0) {
    return {};
  }
  FlowOptions options = plan.flow;
  progress.begin_work("prepare");
  options.on_stage = [&progress](FlowStage stage) { progress.enter(stage); };
  const auto observe = [&](const StepRecord& step) {
    progress.advance(step, options.steps, options.total_time);
    return !parts.any(wants_end());
  };
  const bool restores_walls = !plan.thin.walls.empty() && plan.may_restore();
  const Points start = restores_walls || plan.restores_rims ? X : Points();
  const std::vector<std::uint8_t> fixed = prepare_for_flow(plan, topology, X);
  const FlowReport report = willmore_flow(X, topology, fixed, options, observe, parts);
  if (plan.restores_rims) {
    restore_rims(start, topology, plan.fixed, plan.cutoff, plan.rims->noise, X);
  }
  if (restores_walls) {
    restore_walls(start, topology, fixed, plan.thin, options.laplacian, X);
  }
  return report;
}

}  // namespace ibmfair::commands
