#include "ibmfair/shapes/noise.h"

#include "ibmfair/base/random_numbers.h"

namespace ibmfair {

void add_noise(Points& X, double standard_deviation, std::uint64_t seed) {
  RandomNumbers random(seed);
  for (double& coordinate : X.reshaped<Eigen::RowMajor>()) {
    coordinate += standard_deviation * random.normal();
  }
}

}  // namespace ibmfair
