#include "ibmfair/flow/settings/ring_means.h"

#include <utility>

namespace ibmfair {
namespace {

template <class Rows>
Rows means(Rows values, const Topology& topology, const Unknowns& unknowns, int times) {
  Rows sum(values.rows(), values.cols());
  Eigen::VectorXd count(values.rows());
  for (int time = 0; time < times; ++time) {
    sum = values;
    count.setOnes();
    for (const auto& edge : topology.E.rowwise()) {
      const Index a = unknowns.unknown[edge[0]], b = unknowns.unknown[edge[1]];
      if (a >= 0 && b >= 0) {
        sum.row(a) += values.row(b);
        sum.row(b) += values.row(a);
        count[a] += 1;
        count[b] += 1;
      }
    }
    values = count.cwiseInverse().asDiagonal() * sum;
  }
  return values;
}

}  // namespace

Points ring_means(Points values, const Topology& topology, const Unknowns& unknowns, int times) {
  return means(std::move(values), topology, unknowns, times);
}

Eigen::VectorXd ring_means(Eigen::VectorXd values, const Topology& topology,
                           const Unknowns& unknowns, int times) {
  return means(std::move(values), topology, unknowns, times);
}

}  // namespace ibmfair
