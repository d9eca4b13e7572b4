// The few spots that would hold up the flow of a whole mesh are slowed down, so that the rest goes
// on: on the way of a move first, then by damping, when the Jacobian is renewed.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/culprits.h"
#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/lag.h"

namespace ibmfair {

class BadSpots {
 public:
  explicit BadSpots(FlowProblem& problem);

  /// Before the Jacobian is renewed: makes the metric heavier around the culprits that there were
  /// since that was done last, so that they do not hold up the next steps, too, and holds unknowns
  /// that went as far as they may.
  void damp();

  /// A move (one row per unknown) leads to Y, and takes too little energy off. Where a few culprits
  /// are to blame, shortens it near these and near those before them, and adds the unknowns to
  /// `shortened`; false where that is no way out. `fresh`: no step has been made with the Jacobian.
  bool slow(const Points& Y, bool fresh, Points& move, std::int64_t& shortened);

  /// Whether the last trial failed at a few culprits.
  bool are_to_blame() const { return to_blame_; }

  /// Another move is tried.
  void absolve() { to_blame_ = false; }

  /// Whether something has been slowed down since the Jacobian was renewed, or is damped by it, in
  /// any part of the mesh.
  bool are_slowed() const { return slowed_; }

  /// A step begins.
  void begin_step() { lag_.forget_step(); }

  /// It was made, and took `time`.
  void end_step(double time);

  /// What each unknown has missed, as far as it still shows: time.
  const Eigen::VectorXd& missed() { return lag_.missed(); }

 private:
  template <class Change>
  void for_each_near_culprits(const Change& change) const;

  FlowProblem& problem_;
  Lag lag_;
  std::vector<std::uint8_t> culprits_;  // #V, since the Jacobian was renewed
  std::vector<Index> stopped_;  // unknowns that the Jacobian holds: they went as far as they may
  bool slowed_ = false, to_blame_ = false;
};

}  // namespace ibmfair
