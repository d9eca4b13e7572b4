#include "ibmfair/flow/settings/evenness.h"

#include <algorithm>

#include "ibmfair/flow/settings/ring_means.h"

namespace ibmfair {

double evenness(const Eigen::VectorXd& values, const Topology& topology, const Unknowns& unknowns,
                const std::vector<Index>& counted, int sweeps) {
  Eigen::VectorXd local = ring_means(values, topology, unknowns, sweeps)(counted);
  const double average = local.mean();
  double* const quartile = local.data() + local.size() / 4;
  std::nth_element(local.data(), quartile, local.data() + local.size());
  return average > 0 ? *quartile / average : 0;
}

}  // namespace ibmfair
