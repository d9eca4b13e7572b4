#include "ibmfair/flow/lag.h"

#include <cmath>

#include "ibmfair/base/parallel.h"

namespace ibmfair {

Lag::Lag(Index unknowns, double memory)
    : memory_(memory),
      part_(Eigen::VectorXd::Ones(unknowns)),
      missed_(Eigen::VectorXd::Zero(unknowns)) {}

void Lag::end_step(double time, const Eigen::VectorXd& damping, const std::vector<Index>& stopped) {
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

}  // namespace ibmfair
