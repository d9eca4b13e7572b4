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
  Lag(Index unknowns, double memory);

  /// In the step that is being made, an unknown goes this part of its way, and of that before.
  void slow(Index unknown, double part) { part_[unknown] *= part; }

  /// The step has taken `time`. With each unknown's `damping`, at least 1, it went on for so much
  /// less of it; but for those that were `stopped`, which went as far as they may.
  void end_step(double time, const Eigen::VectorXd& damping, const std::vector<Index>& stopped);

  /// The step is not made after all.
  void forget_step() { part_.setOnes(); }

  /// What each unknown has missed, as far as it still shows: time.
  const Eigen::VectorXd& missed() const { return missed_; }

 private:
  double memory_;
  Eigen::VectorXd part_, missed_;
};

}  // namespace ibmfair
