#include "ibmfair/picture/foreground.h"

namespace ibmfair {

Triangles without_foreground(const Points& X, const Triangles& F, const View& view,
                             const Frame& frame) {
  Triangles kept = F;
  if (frame.X.rows() == 0) {
    return kept;
  }
  const Vec3 back = view.from.normalized();
  const Vec3 origin = frame.X.row(0);  // near the points, for scenes far from the origin
  const auto depths = [&](const Points& points) {
    return Eigen::VectorXd((points.rowwise() - origin.transpose()) * back);
  };
  const double size = (frame.X.colwise().maxCoeff() - frame.X.colwise().minCoeff()).norm();
  const double nearest = depths(frame.X).maxCoeff() + frame.foreground * size;
  const Eigen::VectorXd depth = depths(X);
  for (auto triangle : kept.rowwise()) {
    if (!(depth(triangle).maxCoeff() <= nearest)) {
      triangle.setConstant(triangle[0]);
    }
  }
  return kept;
}

}  // namespace ibmfair
