#include "ibmfair/measure/exact_surface.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

ExactSphere::ExactSphere(Vec3 center, double radius) : center_(std::move(center)), radius_(radius) {
  if (!(radius > 0.0 && std::isfinite(radius))) {
    throw BadOption(
        fmt::format("--sphere: the radius must be positive and finite, not {}", radius));
  }
}

double ExactSphere::signed_distance(const Vec3& x) const {
  return (x - center_).norm() - radius_;
}

Vec3 ExactSphere::normal(const Vec3& x) const {
  const Vec3 d = x - center_;
  return d.norm() > 0.0 ? Vec3(d.normalized()) : Vec3::UnitZ();
}

ExactTorus::ExactTorus(Vec3 center, double axis_radius, double tube_radius)
    : center_(std::move(center)), axis_radius_(axis_radius), tube_radius_(tube_radius) {
  if (!(axis_radius > tube_radius && tube_radius > 0.0 && std::isfinite(axis_radius))) {
    throw BadOption(fmt::format(
        "--torus: the first radius must be larger than the second, but they are {} and {}",
        axis_radius, tube_radius));
  }
}

Vec3 ExactTorus::from_tube_middle(const Vec3& x) const {
  const Vec3 d = x - center_;
  const double r = std::hypot(d[0], d[1]);
  const Vec3 outward = r > 0.0 ? Vec3(d[0] / r, d[1] / r, 0.0) : Vec3::UnitX();
  return d - axis_radius_ * outward;
}

double ExactTorus::signed_distance(const Vec3& x) const {
  return from_tube_middle(x).norm() - tube_radius_;
}

Vec3 ExactTorus::normal(const Vec3& x) const {
  const Vec3 d = from_tube_middle(x);
  return d.norm() > 0.0 ? Vec3(d.normalized()) : Vec3::UnitZ();
}

}  // namespace ibmfair
