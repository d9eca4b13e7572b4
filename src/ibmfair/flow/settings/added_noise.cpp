#include "ibmfair/flow/settings/added_noise.h"

#include <algorithm>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/first_stage.h"
#include "ibmfair/flow/flow_passes.h"
#include "ibmfair/flow/passes/twicing.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

/// Two directions that turn with the mesh, one along the edge to another vertex, both perpendicular
/// to the unit normal of v.
std::pair<Vec3, Vec3> tangents_at(Index v, const Vec3& normal, const TrialMesh& mesh) {
  const auto star = mesh.topology().stars[v];
  Vec3 edge = Vec3::Zero();
  if (!star.empty()) {
    edge = mesh.X().row(other_corners(mesh.topology().F, star[0], v)[0]) - mesh.X().row(v);
  }
  const Vec3 along = (edge - normal.dot(edge) * normal).stableNormalized();
  return {along, normal.cross(along)};
}

/// Noise of the standard deviation 1 in every direction, one row per unknown. It turns with the
/// mesh, so that choices do not depend on its orientation. `normals`: of the unknowns; `model`: the
/// correlations.
Points noise_on(const TrialMesh& mesh, const Unknowns& unknowns, const Points& normals,
                const NoiseModel& model) {
  RandomNumbers random(1);
  Points noise(unknowns.size(), 3);
  for (Index u = 0; u < unknowns.size(); ++u) {
    const Vec3 normal = normals.row(u);
    const auto [along, across] = tangents_at(unknowns.vertex[u], normal, mesh);
    const double x = random.normal(), y = random.normal(), z = random.normal();
    noise.row(u) = x * along + y * across + z * normal;
  }
  return noise_like(model, noise, mesh.topology(), unknowns);
}

double total_time(double cutoff, const TrialMesh& mesh, const FlowOptions& options) {
  return time_in_flow_units(time_for_cutoff(cutoff), mesh.X(), mesh.topology(), options);
}

}  // namespace

AddedNoise::AddedNoise(const TrialMesh& mesh, const NoiseModel& noise, FlowOptions options,
                       double cutoff)
    : mesh_(mesh),
      noise_(noise),
      rings_(vertex_rings(mesh.topology())),
      unknowns_(mesh.fixed()),
      counted_(counted_unknowns(mesh, unknowns_)),
      differences_(counted_, unknowns_, mesh.topology()),
      normals_(unknown_normals(with_filtered_normals(mesh.X(), mesh.topology(), mesh.fixed()),
                               mesh.topology(), unknowns_)) {
  const double deviation = std::max(choice_tuning.cutoff.added_noise * noise.deviation,
                                    choice_tuning.cutoff.least_added * mesh.mean_edge_length());
  starts_[0] = mesh.X();
  starts_[0](unknowns_.vertex, Eigen::all) +=
      deviation * noise_on(mesh, unknowns_, normals_, noise);
  starts_[1] = 2 * mesh.X() - starts_[0];
  added_ = heights(starts_[0], mesh.X());
  if (!noise.is_white()) {
    slope_share_ = mean_square(differences_(added_)) / mean_square(added_);
  }
  options.total_time = total_time(cutoff, mesh, options);
  parallel_tasks(2, [&](std::int64_t i) {
    FlowProblem problem(starts_[i], mesh_.topology(), mesh_.fixed(), options);
    run_first_stage(problem, rings_);
    after_first_stage_[i] = std::move(problem.X);
  });
}

CutoffTrial AddedNoise::trial(double cutoff, const std::array<Points, 2>& ends) const {
  const std::array moves{heights(ends[0], mesh_.X()), heights(ends[1], mesh_.X())};
  const std::array slopes{differences_(moves[0]), differences_(moves[1])};
  const double variance = noise_.variance();
  return {.cutoff = cutoff,
          .risk = risk(variance, added_, moves),
          .slope_risk = risk(slope_share_ * variance, differences_(added_), slopes) / slope_share_,
          .slope_weight = noise_.is_white() ? 0 : choice_tuning.noise.slopes};
}

/// Of what was added to the two meshes, and how their flows have moved the mesh: heights, or
/// differences of heights. `variance`: the same of the noise, length^2.
double AddedNoise::risk(double variance, const Eigen::VectorXd& added,
                        const std::array<Eigen::VectorXd, 2>& moves) const {
  const double squared_moves = mean_square(moves[0]) / 2 + mean_square(moves[1]) / 2;
  const double trace = added.dot(moves[0] - moves[1]) / added.squaredNorm() / 2;
  return squared_moves + variance * (2 * trace - 1);
}

/// Of the counted unknowns.
Eigen::VectorXd AddedNoise::heights(const Points& Y, const Points& over) const {
  return heights_along(normals_, Y, over, unknowns_)(counted_);
}

NoisierFlows::NoisierFlows(const AddedNoise& noise, const FlowOptions& options)
    : noise_(noise), options_(options) {
  options_.steps = std::min(options.steps, choice_tuning.cutoff.leg_steps);
  const TrialMesh& mesh = noise.mesh();
  parallel_tasks(2, [&](std::int64_t i) {
    problems_[i] =
        std::make_unique<FlowProblem>(noise.starts()[i], mesh.topology(), mesh.fixed(), options_);
  });
}

void NoisierFlows::flow_to(double cutoff) {
  const double time = total_time(cutoff, noise_.mesh(), options_);
  const bool goes_on = options_.twicing == 0 && time_ > 0 && time > time_;
  options_.total_time = time - (goes_on ? time_ : 0);
  require_usable(noise_.mesh().X(), noise_.mesh().fixed(), options_);
  parallel_tasks(
      2, [&](std::int64_t i) { flow(*problems_[i], noise_.after_first_stage()[i], goes_on); });
  time_ = time;
}

CutoffTrial NoisierFlows::trial(double cutoff) {
  flow_to(cutoff);
  return noise_.trial(cutoff, {problems_[0]->X, problems_[1]->X});
}

void NoisierFlows::flow(FlowProblem& problem, const Points& from, bool goes_on) const {
  if (!goes_on) {
    Points state = from;
    problem.move_to(state);
  }
  problem.jacobian().damping().setOnes();
  problem.report.status = FlowStatus::completed;
  problem.report.solves = 0;
  problem.report.steps.clear();
  problem.update_gradient();
  run_time_steps(problem, noise_.rings());
  if (options_.twicing > 0 && problem.report.status == FlowStatus::completed) {
    apply_twicing(problem, choice_tuning.cutoff.tolerance);
  }
}

}  // namespace ibmfair
