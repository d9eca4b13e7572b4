#include "ibmfair/flow/passes/rim_extrapolation.h"

#include <set>
#include <vector>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

Eigen::SparseMatrix<double, Eigen::RowMajor> rim_extrapolation(const Topology& topology) {
  const auto is_rim = [&](Index v) {
    return topology.kind[v] == VertexKind::boundary && !topology.twisted[v];
  };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd count = Eigen::VectorXd::Zero(topology.vertex_count);
  const auto predict = [&](Index v, Index a, Index b, Index beyond) {
    if (is_rim(v)) {
      entries.insert(entries.end(), {{v, a, 1.0}, {v, b, 1.0}, {v, beyond, -1.0}});
      ++count[v];
    }
  };
  for (const auto& hinge : topology.H.rowwise()) {
    predict(hinge[2], hinge[0], hinge[1], hinge[3]);
    predict(hinge[3], hinge[0], hinge[1], hinge[2]);
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> mean(topology.vertex_count, topology.vertex_count);
  mean.setFromTriplets(entries.begin(), entries.end());
  return count.cwiseMax(1).cwiseInverse().asDiagonal() * mean;
}

Vec3 normal_beside(const Points& X, const Topology& topology, Index v) {
  std::set<Index> beside;
  for (const Index t : topology.stars[v]) {
    for (const Index q : topology.F.row(t)) {
      beside.insert(topology.stars[q].begin(), topology.stars[q].end());
    }
  }
  Vec3 sum = Vec3::Zero();
  for (const Index t : beside) {
    if ((topology.F.row(t).array() != v).all()) {
      sum += double_area_vector(X, topology.F, t);
    }
  }
  return sum.stableNormalized();
}

}  // namespace ibmfair
