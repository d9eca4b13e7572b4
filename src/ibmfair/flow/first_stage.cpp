#include "ibmfair/flow/first_stage.h"

#include <algorithm>
#include <numbers>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double stage_angle = std::numbers::pi / 3;  // the sharp angle of the first stage
constexpr int stage_steps = 4;
constexpr double most_time = 0.25;  // the longest time, relative to the time of the flow

/// The cut-off of the first stage in mean edge lengths if hinges turn by `noisy_turn` or more on
/// the mean, as with noise of a fifth of the edge length. The cut-off falls in proportion to that
/// angle. A cut-off below one edge would have no effect; then there is no first stage.
constexpr double stage_edges = 2.8, noisy_turn = radians(25);

/// The mean angle by which hinges turn. Creases, which are few, count little.
double mean_turn(const Points& X, const Topology& topology, const MeshParts& parts) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  const Eigen::Array2d sums =
      parallel_sum(angles.size(), Eigen::Array2d(Eigen::Array2d::Zero()), [&](std::int64_t h) {
        const double share = own_share({topology.H.row(h).data(), 2}, parts);
        return Eigen::Array2d(share * std::min(std::numbers::pi - angles[h], stage_angle), share);
      });
  const double turn = parts.sum(sums[0]), count = parts.sum(sums[1]);
  return count > 0 ? turn / count : 0;
}

}  // namespace

std::optional<FlowOptions> first_stage(const Points& X, const Topology& topology,
                                       const FlowOptions& options, const MeshParts& parts) {
  if (!options.guarded || options.sharp_angle <= 0 || options.sharp_angle >= stage_angle) {
    return std::nullopt;
  }
  const double edges = stage_edges * std::min(mean_turn(X, topology, parts) / noisy_turn, 1.0);
  if (edges < 1) {
    return std::nullopt;
  }
  const double time = time_for_cutoff(edges * mean_edge_length(X, topology, parts));
  FlowOptions stage = options;
  stage.sharp_angle = stage_angle;
  stage.total_time = std::min(time_in_flow_units(time, X, topology, options, parts),
                              most_time * options.total_time);
  stage.steps = stage_steps;
  stage.relax = options.relax_first;
  stage.twicing = 0;
  stage.clean_up = false;
  return stage;
}

}  // namespace ibmfair
