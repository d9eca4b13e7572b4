#include "ibmfair/flow/passes/clean_up.h"

#include <algorithm>
#include <atomic>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/passes/unfolding.h"
#include "ibmfair/flow/steps/guarded_move.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

using Flags = std::vector<std::uint8_t>;  // #V

/// Lets the patches of `wanted` vertices flow from their positions at X, each for the time
/// time_of(patch). Writes the moves, and returns whether any vertex moves in any part of the mesh.
template <class TimeOf>
bool flow_in_patches(const FlowProblem& problem, const CompressedRows& rings, const Flags& wanted,
                     const Points& X, const TimeOf& time_of, Points& move) {
  PatchFlow flow(problem, rings);
  move = Points::Zero(problem.unknowns.size(), 3);
  const std::vector<VertexPatch> patches = patches_of(wanted, rings, problem);
  std::atomic<bool> moves = false;
  parallel_tasks(static_cast<std::int64_t>(patches.size()), [&](std::int64_t i) {
    if (flow.run(patches[i], X, time_of(patches[i]), move)) {
      moves = true;
    }
  });
  return problem.parts.any(moves);
}

}  // namespace

void clean_up(FlowProblem& problem, const CompressedRows& rings, const FoldWatch& folds,
              const Eigen::VectorXd& missed) {
  FlowReport& report = problem.report;
  const Stopwatch watch(report.seconds.guard);
  GuardedMove guarded_move(problem, folds);
  Points move;
  const auto make = [&] {
    return guarded_move.make(move, report.energy_after) ? problem.moved(move) : 0;
  };
  if (catch_up_moves(problem, rings, missed, move)) {
    report.caught_up = make();
  }
  if (!(problem.options.sharp_angle > 0) && unfolding_moves(problem, rings, move)) {
    report.unfolded = make();
  }
  report.shortened_relaxations += guarded_move.failures();
  if (!report.steps.empty()) {
    report.steps.back().energy = report.energy_after;
  }
}

bool catch_up_moves(const FlowProblem& problem, const CompressedRows& rings,
                    const Eigen::VectorXd& deficit, Points& move) {
  const double little = tuning.clean_up.little_deficit * problem.report.time_reached;
  if (!problem.parts.any((deficit.array() > little).any())) {
    return false;
  }
  Flags wanted(static_cast<std::size_t>(problem.topology.vertex_count), 0);
  for (Index u = 0; u < problem.unknowns.size(); ++u) {
    wanted[problem.unknowns.vertex[u]] = deficit[u] > little ? 1 : 0;
  }
  for (int i = 0; i < tuning.clean_up.rings_around; ++i) {
    wanted = grow_one_ring(problem.topology, wanted);
  }
  const auto longest_deficit = [&](const VertexPatch& patch) {
    double longest = little;  // for a patch whose middle is in another part of the mesh
    for (const Index v : patch) {
      longest = std::max(longest, deficit[problem.unknowns.unknown[v]]);
    }
    return longest;
  };
  return flow_in_patches(problem, rings, wanted, problem.X, longest_deficit, move);
}

bool unfolding_moves(FlowProblem& problem, const CompressedRows& rings, Points& move) {
  const bool measures_curvature = !bending_model(problem.options.laplacian).evens_edges;
  std::vector<VertexPatch> patches;
  if (!problem.has_no_folds(problem.energy_at(problem.X), tuning.clean_up.fold)) {
    patches = find_folded_patches(
        problem, rings,
        measures_curvature ? tuning.clean_up.flat : tuning.clean_up.flat_without_curvature);
  }
  return even_out_and_flow(problem, rings, patches, move);
}

bool even_out_and_flow(const FlowProblem& problem, const CompressedRows& rings,
                       const std::vector<VertexPatch>& patches, Points& move) {
  if (!problem.parts.any(!patches.empty())) {
    return false;
  }
  Points X = problem.X;
  Flags wanted(static_cast<std::size_t>(problem.topology.vertex_count), 0);
  for (const VertexPatch& patch : patches) {
    even_out(patch, rings, X);
    for (const Index v : patch) {
      wanted[v] = 1;
    }
  }
  wanted = grow_one_ring(problem.topology, wanted);
  const auto all_of_it = [&](const VertexPatch&) { return problem.options.total_time; };
  return flow_in_patches(problem, rings, wanted, X, all_of_it, move);
}

}  // namespace ibmfair
