#include "ibmfair/flow/settings/ring_means.h"

#include <utility>

namespace ibmfair {
namespace {

template <class Rows>
Rows means(Rows values, const Topology& topology, const Unknowns& unknowns, int times) {
  const auto for_neighbours = [&](const auto& use) {
    for (const auto& edge : topology.E.rowwise()) {
      const Index a = unknowns.unknown[edge[0]], b = unknowns.unknown[edge[1]];
      if (a >= 0 && b >= 0) {
        use(a, b);
      }
    }
  };
  Eigen::VectorXd count = Eigen::VectorXd::Ones(values.rows());
  for_neighbours([&](Index a, Index b) {
    count[a] += 1;
    count[b] += 1;
  });
  Rows sum(values.rows(), values.cols());
  for (int time = 0; time < times; ++time) {
    sum = values;
    for_neighbours([&](Index a, Index b) {
      sum.row(a) += values.row(b);
      sum.row(b) += values.row(a);
    });
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
