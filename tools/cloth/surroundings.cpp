#include "cloth/surroundings.h"

#include "ibmfair/mesh/geometry.h"

namespace ibmfair::cloth {
namespace {

void add_wind(const Plate& plate, const Surroundings& surroundings, const Points& X,
              const Points& V, Points& F) {
  for (const auto& t : plate.topology.F.rowwise()) {
    const Vec3 N = double_area_vector(X.row(t[0]), X.row(t[1]), X.row(t[2]));
    const Vec3 velocity = (V.row(t[0]) + V.row(t[1]) + V.row(t[2])) / 3;
    const double double_area = N.norm();
    if (!(double_area > 0)) {
      continue;
    }
    const double across = N.dot(surroundings.wind - velocity) / double_area;
    const Vec3 third = surroundings.drag * across / 6 * N;
    for (const Index v : t) {
      F.row(v) += third;
    }
  }
}

}  // namespace

void external_forces(const Plate& plate, const Surroundings& surroundings, const Points& X,
                     const Points& V, Points& F) {
  F = plate.mass * surroundings.gravity.transpose();
  if (surroundings.drag > 0) {
    add_wind(plate, surroundings, X, V, F);
  }
}

}  // namespace ibmfair::cloth
