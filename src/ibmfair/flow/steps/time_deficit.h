// The flow time by which regions that a flow slows down lag behind the rest of the mesh.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

class TimeDeficit {
 public:
  /// Starts with no unknown lagging behind. `memory`: the flow time in which a region that was
  /// slowed down, and then flows at full speed, makes up for most of its deficit. Such regions are
  /// small, and catch up long before the flow has smoothed everything up to the cut-off.
  TimeDeficit(Index unknowns, double memory) : unknowns_(unknowns), memory_(memory) {}

  /// Scales the progress of this unknown in the current step by `part`; calls accumulate.
  void slow(Index unknown, double part);

  /// Ends a step of length `time`. The progress of each unknown is divided by its `damping` (at
  /// least 1). The `stopped` unknowns do not lag behind: they are at their bound on moves.
  void end_step(double time, const Eigen::VectorXd& damping, const std::vector<Index>& stopped);

  /// Discards the scales of the current step, as the step is not made.
  void forget_step() { part_.setOnes(); }

  /// Whether no unknown has been slowed or damped yet.
  bool is_empty() const { return part_.size() == 0; }

  /// The flow time that each unknown has missed and not yet made up for (see `memory`).
  const Eigen::VectorXd& missed() {
    make_room();
    return missed_;
  }

 private:
  /// Allocates the vectors on first use, because most flows slow nothing down.
  void make_room();

  Index unknowns_;
  double memory_;
  Eigen::VectorXd part_, missed_;  // one entry per unknown, or none yet
};

}  // namespace ibmfair
