#include "ibmfair/flow/bad_spots.h"

#include <algorithm>

namespace ibmfair {
namespace {

// Chosen in the same way as the settings of the guard (guarded_flow.cpp).
constexpr double slower = 0.1;                // factor of moves near culprits
constexpr double heavier = 256, lighter = 4;  // factors by which damping grows and fades
constexpr double standstill = 1e12;           // damping of a vertex stopped by the bound on moves
constexpr double memory = 1.0 / 4;            // Lag's memory, relative to the total time

}  // namespace

BadSpots::BadSpots(FlowProblem& problem)
    : problem_(problem),
      lag_(problem.unknowns.size(), memory * problem.options.total_time),
      culprits_(static_cast<std::size_t>(problem.topology.vertex_count), 0) {}

void BadSpots::damp() {
  Eigen::VectorXd& damping = problem_.jacobian().damping();
  damping(stopped_).setOnes();
  damping = (damping / lighter).cwiseMax(1.0);
  for_each_near_culprits([&](Index u) { damping[u] *= heavier; });
  std::ranges::fill(culprits_, std::uint8_t{0});
  slowed_ = problem_.parts.any((damping.array() > 1).any());
  stopped_ = problem_.stopped();
  damping(stopped_).setConstant(standstill);
}

bool BadSpots::slow(const Points& Y, bool fresh, Points& move, std::int64_t& shortened) {
  const Culprits found = find_culprits(problem_, problem_.gradient_at(Y), move);
  to_blame_ = found.are_local;
  // If the energy rises in many places, and the Jacobian is old and damps nothing yet, its age is
  // the cause, and the vertices found are no culprits.
  if (to_blame_ || fresh || slowed_) {
    for (const Index v : found.vertices) {
      culprits_[v] = 1;
    }
    problem_.parts.refresh(culprits_);
  }
  if (!to_blame_) {
    return false;
  }
  for_each_near_culprits([&](Index u) {
    move.row(u) *= slower;
    lag_.slow(u, slower);
    ++shortened;
  });
  slowed_ = true;
  return true;
}

void BadSpots::end_step(double time) {
  if (slowed_ || !lag_.is_empty()) {
    lag_.end_step(time, problem_.jacobian().damping(), stopped_);
  }
}

/// Calls change(u) for the unknowns u that are culprits or neighbours of culprits.
template <class Change>
void BadSpots::for_each_near_culprits(const Change& change) const {
  if (std::ranges::find(culprits_, 1) == culprits_.end()) {
    return;
  }
  const std::vector<std::uint8_t> near = grow_one_ring(problem_.topology, culprits_);
  for (Index u = 0; u < problem_.unknowns.size(); ++u) {
    if (near[problem_.unknowns.vertex[u]]) {
      change(u);
    }
  }
}

}  // namespace ibmfair
