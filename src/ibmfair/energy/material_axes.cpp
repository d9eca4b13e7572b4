#include "ibmfair/energy/material_axes.h"

#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

MaterialDirection along(const Vec3& direction, double factor, const Vec3& N,
                        const std::array<Vec3, 3>& opposite) {
  MaterialDirection result{{}, factor};
  for (int i = 0; i < 3; ++i) {  // the gradient of a basis function is N x e / |N|^2
    result.rate[i] = direction.dot(N.cross(opposite[i])) / N.squaredNorm();
  }
  return result;
}

MaterialAxes axes_of(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& direction,
                     double factor) {
  const std::array<Vec3, 3> opposite{x2 - x1, x0 - x2, x1 - x0};
  const Vec3 N = double_area_vector(x0, x1, x2);
  const Vec3 n = N.normalized();
  const Vec3 within = direction - direction.dot(n) * n;
  // Where nothing lies within, both factors are 1 and any two axes do.
  const Vec3 v = (within.squaredNorm() > 0 ? within : opposite[0]).normalized();
  const double faded = 1 + (factor - 1) * within.squaredNorm();
  return {along(v, faded, N, opposite), along(n.cross(v), 1, N, opposite)};
}

}  // namespace

std::vector<MaterialAxes> material_axes(const Points& X, const Topology& topology,
                                        const Vec3& direction, double factor) {
  const double length = direction.norm();
  if (!(length > 0 && std::isfinite(length))) {
    throw BadOption("a material direction needs a length");
  }
  if (!(factor > 0 && std::isfinite(factor))) {
    throw BadOption("the factor of a material direction must be positive");
  }
  std::vector<MaterialAxes> axes(static_cast<std::size_t>(topology.F.rows()));
  parallel_for(topology.F.rows(), [&](std::int64_t t) {
    const auto x = topology.F.row(t);
    axes[t] = axes_of(X.row(x[0]), X.row(x[1]), X.row(x[2]), direction / length, factor);
  });
  return axes;
}

}  // namespace ibmfair
