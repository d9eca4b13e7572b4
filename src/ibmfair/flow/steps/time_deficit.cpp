#include "ibmfair/flow/steps/time_deficit.h"

#include <cmath>

#include "ibmfair/base/parallel.h"

namespace ibmfair {

void TimeDeficit::end_step(double time, const Eigen::VectorXd& damping,
                           const std::vector<Index>& stopped) {
  make_room();
  for (const Index u : stopped) {
    part_[u] = damping[u];
  }
  parallel_for(missed_.size(), [&](std::int64_t u) {
    const double pace = part_[u] / damping[u];
    if (pace < 1 || missed_[u] > 0) {
      missed_[u] = (missed_[u] + (1 - pace) * time) * std::exp(-pace * time / memory_);
    }
    part_[u] = 1;
  });
}

void TimeDeficit::slow(Index unknown, double part) {
  make_room();
  part_[unknown] *= part;
}

void TimeDeficit::make_room() {
  if (part_.size() != unknowns_) {
    part_.setOnes(unknowns_);
    missed_.setZero(unknowns_);
  }
}

}  // namespace ibmfair
