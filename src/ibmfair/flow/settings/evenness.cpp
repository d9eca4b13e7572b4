#include "ibmfair/flow/settings/evenness.h"

#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/settings/ring_means.h"

namespace ibmfair {

double evenness(const Eigen::VectorXd& values, const Topology& topology, const Unknowns& unknowns,
                const std::vector<Index>& counted, int sweeps) {
  Eigen::VectorXd local = ring_means(values, topology, unknowns, sweeps)(counted);
  const double average = local.mean();
  return average > 0 ? quantile({local.data(), counted.size()}, 0.25) / average : 0;
}

}  // namespace ibmfair
