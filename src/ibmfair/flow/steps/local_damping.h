// Slows down the few spots at which a step of the flow would raise the energy, so that the rest of
// the mesh can go on. The present step is shortened there first; when the Jacobian is renewed, the
// metric is made heavier there (damping).
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/time_deficit.h"
#include "ibmfair/flow/steps/uphill_vertices.h"

namespace ibmfair {

/// The damping of all unknowns, and the flow time that they have missed.
class LocalDamping {
 public:
  explicit LocalDamping(FlowProblem& problem);

  /// To be called before the Jacobian is renewed. Makes the metric heavier around the uphill
  /// vertices (the vertices that raise the energy, uphill_vertices.h) found since the previous
  /// call, so that the next steps do not fail there again, and fixes the unknowns stopped by
  /// FlowOptions::max_move.
  void damp();

  /// To be called when a move (one row per unknown) to Y lowers the energy too little. If a few
  /// uphill vertices are the cause, shortens the move near them and near the uphill vertices found
  /// earlier, adds the number of shortened rows to `shortened`, and returns true; otherwise returns
  /// false. `fresh`: no step has been made with the present Jacobian yet.
  bool slow(const Points& Y, bool fresh, Points& move, std::int64_t& shortened);

  /// Whether the last trial of the present step failed because of a few uphill vertices.
  bool failed_locally() const { return failed_locally_; }

  /// Whether any unknown, in any part of the mesh, has been slowed down since the Jacobian was
  /// renewed, or is damped by the Jacobian.
  bool is_active() const { return slowed_; }

  /// To be called when a step begins.
  void begin_step() {
    failed_locally_ = false;
    deficit_.forget_step();
  }

  /// To be called after an accepted step of length `time`.
  void end_step(double time);

  /// The flow time by which each unknown lags behind (TimeDeficit::missed).
  const Eigen::VectorXd& missed() { return deficit_.missed(); }

 private:
  template <class Change>
  void for_each_near_uphill(const Change& change) const;

  FlowProblem& problem_;
  TimeDeficit deficit_;
  std::vector<std::uint8_t> uphill_;  // #V, found since the Jacobian was renewed
  std::vector<Index> stopped_;        // unknowns at FlowOptions::max_move, fixed by heavy damping
  bool slowed_ = false, failed_locally_ = false;
};

}  // namespace ibmfair
