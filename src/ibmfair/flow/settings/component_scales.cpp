#include "ibmfair/flow/settings/component_scales.h"

#include "ibmfair/flow/settings/choice_tuning.h"

namespace ibmfair {

Eigen::VectorXd component_scales(const Points& X, const Topology& topology) {
  if (topology.component_count < 2) {
    return {};
  }
  Eigen::ArrayXd length = Eigen::ArrayXd::Zero(topology.component_count), edges = length,
                 vertices = length;
  for (Eigen::Index e = 0; e < topology.E.rows(); ++e) {
    if (const Index c = topology.component[topology.E(e, 0)]; c >= 0) {
      length[c] += (X.row(topology.E(e, 0)) - X.row(topology.E(e, 1))).norm();
      ++edges[c];
    }
  }
  for (const Index c : topology.component) {
    if (c >= 0) {
      ++vertices[c];
    }
  }
  const Eigen::ArrayXd mean = length / edges.max(1);
  const double largest =
      (vertices >= choice_tuning.components.share * vertices.sum()).select(mean, 0).maxCoeff();
  const Eigen::ArrayXd scale = (mean / largest).min(1);
  if (!(scale < choice_tuning.components.alike).any()) {
    return {};
  }
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(topology.vertex_count);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    // A component without an edge of any length has no scale.
    if (const Index c = topology.component[v]; c >= 0 && scale[c] > 0) {
      factors[v] = scale[c];
    }
  }
  return factors;
}

}  // namespace ibmfair
