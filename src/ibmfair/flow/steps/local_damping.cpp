#include "ibmfair/flow/steps/local_damping.h"

#include <algorithm>

#include "ibmfair/flow/tuning.h"

namespace ibmfair {
LocalDamping::LocalDamping(FlowProblem& problem)
    : problem_(problem),
      deficit_(problem.unknowns.size(), tuning.damping.memory * problem.options.total_time),
      uphill_(static_cast<std::size_t>(problem.topology.vertex_count), 0) {}

void LocalDamping::damp() {
  Eigen::VectorXd& damping = problem_.jacobian().damping();
  damping(stopped_).setOnes();
  damping = (damping / tuning.damping.lighter).cwiseMax(1.0);
  for_each_near_uphill([&](Index u) { damping[u] *= tuning.damping.heavier; });
  std::ranges::fill(uphill_, std::uint8_t{0});
  slowed_ = problem_.parts.any((damping.array() > 1).any());
  stopped_ = problem_.stopped();
  damping(stopped_).setConstant(tuning.damping.standstill);
}

bool LocalDamping::slow(const Points& Y, bool fresh, Points& move, std::int64_t& shortened) {
  const UphillVertices found = find_uphill_vertices(problem_, problem_.gradient_at(Y), move);
  failed_locally_ = found.are_local;
  // If the energy rises in many places, and the Jacobian is old and damps nothing yet, its age is
  // the cause, and the vertices found are no uphill vertices.
  if (failed_locally_ || fresh || slowed_) {
    for (const Index v : found.vertices) {
      uphill_[v] = 1;
    }
    problem_.parts.refresh(uphill_);
  }
  if (!failed_locally_) {
    return false;
  }
  for_each_near_uphill([&](Index u) {
    move.row(u) *= tuning.damping.slower;
    deficit_.slow(u, tuning.damping.slower);
    ++shortened;
  });
  slowed_ = true;
  return true;
}

void LocalDamping::end_step(double time) {
  if (slowed_ || !deficit_.is_empty()) {
    deficit_.end_step(time, problem_.jacobian().damping(), stopped_);
  }
}

/// Calls change(u) for the unknowns u that are uphill vertices or neighbours of uphill vertices.
template <class Change>
void LocalDamping::for_each_near_uphill(const Change& change) const {
  if (std::ranges::find(uphill_, 1) == uphill_.end()) {
    return;
  }
  const std::vector<std::uint8_t> near = grow_one_ring(problem_.topology, uphill_);
  for (Index u = 0; u < problem_.unknowns.size(); ++u) {
    if (near[problem_.unknowns.vertex[u]]) {
      change(u);
    }
  }
}

}  // namespace ibmfair
