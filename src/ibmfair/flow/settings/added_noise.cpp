#include "ibmfair/flow/settings/added_noise.h"

#include <algorithm>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/first_stage.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/flow/willmore_flow.h"
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

/// The mesh with white noise of this standard deviation in every direction. The noise turns with
/// the mesh, so that choices do not depend on its orientation. `normals`: of the unknowns.
Points with_more_noise(const TrialMesh& mesh, const Unknowns& unknowns, const Points& normals,
                       double deviation) {
  Points Y = mesh.X();
  RandomNumbers random(1);
  for (Index u = 0; u < unknowns.size(); ++u) {
    const Index v = unknowns.vertex[u];
    const Vec3 normal = normals.row(u);
    const auto [along, across] = tangents_at(v, normal, mesh);
    const double x = random.normal(), y = random.normal(), z = random.normal();
    Y.row(v) += deviation * (x * along + y * across + z * normal);
  }
  return Y;
}

}  // namespace

AddedNoise::AddedNoise(const TrialMesh& mesh, double noise)
    : mesh_(mesh),
      noise_(noise),
      unknowns_(mesh.fixed()),
      counted_(counted_unknowns(mesh, unknowns_)),
      normals_(unknown_normals(with_filtered_normals(mesh.X(), mesh.topology(), mesh.fixed()),
                               mesh.topology(), unknowns_)),
      noisier_(with_more_noise(mesh, unknowns_, normals_,
                               std::max(tuning.cutoff.added_noise * noise,
                                        tuning.cutoff.least_added * mesh.mean_edge_length()))),
      added_(heights(noisier_, mesh.X())) {}

double AddedNoise::risk(FlowOptions options, double cutoff) const {
  options.total_time =
      time_in_flow_units(time_for_cutoff(cutoff), mesh_.X(), mesh_.topology(), options);
  options.steps = std::min(options.steps, tuning.cutoff.leg_steps);
  Points plus = noisier_, minus = 2 * mesh_.X() - noisier_;
  parallel_tasks(2, [&](std::int64_t i) {
    willmore_flow(i == 0 ? plus : minus, mesh_.topology(), mesh_.fixed(), options);
  });
  const double squared_moves =
      heights(plus, mesh_.X()).squaredNorm() / 2 + heights(minus, mesh_.X()).squaredNorm() / 2;
  const double trace = added_.dot(heights(plus, minus)) / added_.squaredNorm() / 2;
  return squared_moves / static_cast<double>(counted_.size()) + noise_ * noise_ * (2 * trace - 1);
}

/// Of the counted unknowns.
Eigen::VectorXd AddedNoise::heights(const Points& Y, const Points& over) const {
  return heights_along(normals_, Y, over, unknowns_)(counted_);
}

}  // namespace ibmfair
