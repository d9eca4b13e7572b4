#include "ibmfair/measure/matching_meshes.h"

#include <algorithm>

namespace ibmfair {

namespace {

// Twice the area vector (Newell's formula) in units of the polygon's size, so that nothing
// underflows.
Vec3 polygon_normal(const Points& X, std::span<const Index> corners) {
  const auto from_first = [&](std::size_t i) -> Vec3 {
    return X.row(corners[i]) - X.row(corners[0]);
  };
  double size = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    size = std::max(size, from_first(i).cwiseAbs().maxCoeff());
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; size > 0.0 && i + 1 < corners.size(); ++i) {
    sum += (from_first(i) / size).cross(from_first(i + 1) / size);
  }
  return sum;
}

}  // namespace

bool same_connectivity(const Mesh& a, const Mesh& b) {
  return a.X.rows() == b.X.rows() && a.faces.first == b.faces.first &&
         a.faces.corner == b.faces.corner;
}

Statistics vertex_differences(const Points& A, const Points& B) {
  Eigen::VectorXd distances(A.rows());
  for (Eigen::Index v = 0; v < A.rows(); ++v) {
    distances[v] = (A.row(v) - B.row(v)).stableNorm();
  }
  return summarise(distances);
}

NormalAngles face_normal_angles(const Mesh& a, const Mesh& b) {
  Eigen::VectorXd degrees(a.faces.size());
  for (Index f = 0; f < a.faces.size(); ++f) {
    degrees[f] = degrees_between(polygon_normal(a.X, a.faces[f]), polygon_normal(b.X, b.faces[f]));
  }
  return summarise_angles(degrees);
}

}  // namespace ibmfair
