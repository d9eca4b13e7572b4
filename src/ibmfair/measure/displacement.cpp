#include "ibmfair/measure/displacement.h"

#include <limits>

#include "ibmfair/measure/mean_curvature.h"

namespace ibmfair {
namespace {

PerVertex with_new_vertices(const Eigen::VectorXd& known, Eigen::Index count) {
  PerVertex values = PerVertex::Constant(count, std::numeric_limits<double>::quiet_NaN());
  values.head(known.size()) = known;
  return values;
}

}  // namespace

PerVertex normal_displacement(const Points& before, const Points& X, const Topology& topology) {
  const Points normals = star_normals(X, topology);
  const Eigen::Index known = before.rows();
  return with_new_vertices(
      (X.topRows(known) - before).cwiseProduct(normals.topRows(known)).rowwise().sum(), X.rows());
}

PerVertex displacement_length(const Points& before, const Points& X) {
  return with_new_vertices((X.topRows(before.rows()) - before).rowwise().norm(), X.rows());
}

}  // namespace ibmfair
