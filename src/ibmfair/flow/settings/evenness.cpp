#include "ibmfair/flow/settings/evenness.h"

#include <algorithm>

namespace ibmfair {

double evenness(const Eigen::VectorXd& values, const Topology& topology, const Unknowns& unknowns,
                const std::vector<Index>& counted, int sweeps) {
  Eigen::VectorXd mean = values;
  Eigen::VectorXd sum(values.size()), count(values.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    sum = mean;
    count.setOnes();
    for (const auto& edge : topology.E.rowwise()) {
      const Index a = unknowns.unknown[edge[0]], b = unknowns.unknown[edge[1]];
      if (a >= 0 && b >= 0) {
        sum[a] += mean[b];
        sum[b] += mean[a];
        count[a] += 1;
        count[b] += 1;
      }
    }
    mean = sum.cwiseQuotient(count);
  }
  Eigen::VectorXd local = mean(counted);
  const double average = local.mean();
  double* const quartile = local.data() + local.size() / 4;
  std::nth_element(local.data(), quartile, local.data() + local.size());
  return average > 0 ? *quartile / average : 0;
}

}  // namespace ibmfair
