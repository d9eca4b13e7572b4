#include "ibmfair/energy/material_directions.h"

#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

MaterialDirection laid_onto(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& direction,
                            double factor) {
  const std::array<Vec3, 3> opposite{x2 - x1, x0 - x2, x1 - x0};
  const Vec3 N = double_area_vector(x0, x1, x2);
  const Vec3 n = N.normalized();
  const Vec3 within = direction - direction.dot(n) * n;
  // If the projection is zero, the factor is 1, and any direction can be used.
  const Vec3 v = (within.squaredNorm() > 0 ? within : opposite[0]).normalized();
  MaterialDirection result{{}, 1 + (factor - 1) * within.squaredNorm()};
  for (int i = 0; i < 3; ++i) {  // the gradient of a basis function is N x e / |N|^2
    result.rate[i] = v.dot(N.cross(opposite[i])) / N.squaredNorm();
  }
  return result;
}

}  // namespace

std::vector<MaterialDirection> material_directions(const Points& X, const Topology& topology,
                                                   const Vec3& direction, double factor) {
  const double length = direction.norm();
  if (!(length > 0 && std::isfinite(length))) {
    throw BadOption("--anisotropy: the direction must not be 0,0,0");
  }
  if (!(factor > 0 && std::isfinite(factor))) {
    throw BadOption("--anisotropy: FACTOR must be positive");
  }
  std::vector<MaterialDirection> directions(static_cast<std::size_t>(topology.F.rows()));
  parallel_for(topology.F.rows(), [&](std::int64_t t) {
    const auto x = topology.F.row(t);
    directions[t] = laid_onto(X.row(x[0]), X.row(x[1]), X.row(x[2]), direction / length, factor);
  });
  return directions;
}

}  // namespace ibmfair
