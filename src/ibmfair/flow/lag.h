// How far spots that a flow slows down lag behind the rest of the mesh.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

class Lag {
 public:
  /// Nothing lags behind. `memory`: the time after which what was held up for a while, and then
  /// flows on, hardly shows it any more: spots are small, and catch up long before the flow has
  /// smoothed what it is made to smooth.
  Lag(Index unknowns, double memory) : unknowns_(unknowns), memory_(memory) {}

  /// In the step that is being made, an unknown goes this part of its way, and of that before.
  void slow(Index unknown, double part);

  /// The step has taken `time`. With each unknown's `damping`, at least 1, it went on for so much
  /// less of it; but for those that were `stopped`, which went as far as they may.
  void end_step(double time, const Eigen::VectorXd& damping, const std::vector<Index>& stopped);

  /// The step is not made after all.
  void forget_step() { part_.setOnes(); }

  /// Whether nothing has been slowed or damped yet, so that there is nothing to keep.
  bool is_empty() const { return part_.size() == 0; }

  /// What each unknown has missed, as far as it still shows: time.
  const Eigen::VectorXd& missed() {
    make_room();
    return missed_;
  }

 private:
  /// Most flows slow nothing down.
  void make_room();

  Index unknowns_;
  double memory_;
  Eigen::VectorXd part_, missed_;  // one entry per unknown, or none yet
};

}  // namespace ibmfair
