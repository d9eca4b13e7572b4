#include "ibmfair/measure/surface_deviation.h"

#include <cmath>
#include <vector>

#include "ibmfair/measure/used_vertices.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

SurfaceDeviation deviation_from(const ExactSurface& surface, const Points& X, const Triangles& F) {
  const std::vector<Index> vertices = used_vertices(F);
  Eigen::VectorXd distances(static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    distances[static_cast<Eigen::Index>(i)] = std::abs(surface.signed_distance(X.row(vertices[i])));
  }
  const Points normals = triangle_normals(X, F);
  Eigen::VectorXd degrees(F.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f) {
    const Vec3 centroid = (X.row(F(f, 0)) + X.row(F(f, 1)) + X.row(F(f, 2))) / 3.0;
    degrees[f] = degrees_between(normals.row(f), surface.normal(centroid));
  }
  SurfaceDeviation result{summarise(distances), summarise_angles(degrees)};
  if (result.distance.where >= 0) {
    result.distance.where = vertices[static_cast<std::size_t>(result.distance.where)];
  }
  return result;
}

}  // namespace ibmfair
