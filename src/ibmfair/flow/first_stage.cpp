#include "ibmfair/flow/first_stage.h"

#include <algorithm>
#include <numbers>

#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/steps/fold_free_move.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/guided_normals.h"

namespace ibmfair {
namespace {

/// The mean angle by which hinges turn. Creases, which are few, count little.
double mean_turn(const FlowProblem& problem) {
  const Topology& topology = problem.topology;
  const MeshParts& parts = problem.parts;
  const Eigen::VectorXd angles = dihedral_angles(problem.start(), topology.H);
  const Eigen::Array2d sums =
      parallel_sum(angles.size(), Eigen::Array2d(Eigen::Array2d::Zero()), [&](std::int64_t h) {
        const double share = own_share({topology.H.row(h).data(), 2}, parts);
        return Eigen::Array2d(
            share * std::min(std::numbers::pi - angles[h], tuning.first_stage.angle), share);
      });
  const double turn = parts.sum(sums[0]), count = parts.sum(sums[1]);
  return count > 0 ? turn / count : 0;
}

bool has_folds(const Points& X, const Topology& topology) {
  return std::ranges::count(folded_hinges(X, topology), 1) > 0;
}

}  // namespace

std::optional<FlowOptions> first_stage_options(const FlowProblem& problem) {
  const FlowOptions& options = problem.options;
  if (!options.guarded || options.sharp_angle <= 0 ||
      options.sharp_angle >= tuning.first_stage.angle) {
    return std::nullopt;
  }
  const double turn = mean_turn(problem) / tuning.first_stage.noisy_turn;
  const double edges = tuning.first_stage.edges * std::min(turn, 1.0);
  if (edges < 1) {  // such a cut-off would have no effect
    return std::nullopt;
  }
  const double edge = mean_edge_length(problem.start(), problem.topology, problem.parts);
  const double time = time_in_flow_units(time_for_cutoff(edges * edge), problem.start(),
                                         problem.topology, options, problem.parts);
  FlowOptions stage = options;
  stage.sharp_angle = tuning.first_stage.angle;
  stage.total_time = std::min(time, tuning.first_stage.most_time * options.total_time);
  stage.steps = tuning.first_stage.steps;
  stage.relax = options.relax_first;
  stage.twicing = 0;
  stage.clean_up = false;
  if (!problem.topology.orientable) {
    stage.first_stage = FirstStage::flow;  // where no orientation agrees, normals do not compare
  }
  if (stage.first_stage == FirstStage::normals) {
    stage.keep_volume = stage.keep_area = false;  // the time steps restore them
  }
  return stage;
}

Points with_filtered_normals(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed) {
  const FirstStageTuning& tuned = tuning.first_stage;
  const Points normals = guided_normals(X, topology, tuned.normal_sweeps, tuned.unlike);
  return fit_to_normals(X, topology, fixed, normals, tuned.vertex_sweeps);
}

void filter_normals(FlowProblem& stage) {
  const Points& start = stage.start();
  const Points fitted = with_filtered_normals(start, stage.topology, stage.fixed);
  const auto& vertex = stage.unknowns.vertex;
  Points move = fitted(vertex, Eigen::all) - start(vertex, Eigen::all), Y;
  // The filter removes most of the folds of strong noise, and makes some new ones, which the flow
  // removes. Without strong noise, it only folds slivers over.
  if (has_folds(start, stage.topology)) {
    stage.displace(move, Y);
  } else {
    displace_without_folds(stage, FoldWatch(start, stage.topology), move, Y,
                           [&stage](const Points& X) { return stage.energy_at(X); });
  }
  stage.move_to(Y);
}

}  // namespace ibmfair
