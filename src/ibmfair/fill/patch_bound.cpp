#include "ibmfair/fill/patch_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

// A patch may reach this many times as far from the middle of the rim as the rim itself, or as the
// missing part of the sphere.
constexpr double most_reach = 2;
constexpr double most_area = 3;  // the same for the area

constexpr double deep_height = 0.15;  // above this, more than a half sphere is missing, in radii
constexpr double most_deviation = 0.1;
// The sphere may be this many times as large as the rim. Of a larger one so little is left that the
// normals do not determine its size.
constexpr double most_radius = 12;

Vec3 middle_of_rim(const Patch& patch) {
  Vec3 sum = Vec3::Zero();
  for (const RimEdge& edge : patch.rim) {
    sum += patch.X.row(edge.a);
  }
  return sum / static_cast<double>(patch.rim.size());
}

double radius_of_rim(const Patch& patch, const Vec3& middle) {
  double largest = 0;
  for (const RimEdge& edge : patch.rim) {
    largest = std::max(largest, (patch.X.row(edge.a).transpose() - middle).norm());
  }
  return largest;
}

Vec3 area_vector_of_rim(const Patch& patch, const Vec3& middle) {
  Vec3 sum = Vec3::Zero();
  for (const RimEdge& edge : patch.rim) {
    const Vec3 a = patch.X.row(edge.a), b = patch.X.row(edge.b);
    sum += (a - middle).cross(b - middle) / 2;
  }
  return sum;
}

/// The triangles of the mesh along the rim: barycentres, unit normals and areas.
struct RimBand {
  Points X, N;
  Eigen::VectorXd area;

  explicit RimBand(const Patch& patch)
      : X(Points::Zero(patch.surroundings.rows(), 3)), N(X), area(X.rows()) {
    for (Eigen::Index t = 0; t < X.rows(); ++t) {
      const auto x = patch.surroundings.row(t);
      const Vec3 n = double_area_vector(patch.X.row(x[0]), patch.X.row(x[1]), patch.X.row(x[2]));
      X.row(t) = (patch.X.row(x[0]) + patch.X.row(x[1]) + patch.X.row(x[2])) / 3;
      N.row(t) = n.normalized();
      area[t] = n.norm() / 2;
    }
  }
};

}  // namespace

bool RimSphere::is_deep() const {
  return height > deep_height * radius && deviation < most_deviation;
}

double RimSphere::missing_area() const {
  return 2 * std::numbers::pi * radius * (radius + height);
}

/// Minimises sum area |x - center - s n|^2 over the centre and the signed radius s.
std::optional<RimSphere> fit_rim_sphere(const Patch& patch) {
  const Vec3 middle = middle_of_rim(patch);
  const Vec3 area_vector = area_vector_of_rim(patch, middle);
  const RimBand band(patch);
  const double area = band.area.sum();
  if (!(area > 0) || !(area_vector.norm() > 0)) {
    return {};
  }
  const Vec3 x = band.X.transpose() * band.area / area, n = band.N.transpose() * band.area / area;
  const Points dX = band.X.rowwise() - x.transpose(), dN = band.N.rowwise() - n.transpose();
  const double covariance = dX.cwiseProduct(dN).rowwise().sum().dot(band.area);
  const double variance = dN.rowwise().squaredNorm().dot(band.area);
  const double s = covariance / variance;
  RimSphere sphere;
  sphere.center = x - s * n;
  double sum = 0, squares = 0;
  for (const RimEdge& edge : patch.rim) {
    const double r = (patch.X.row(edge.a).transpose() - sphere.center).norm();
    sum += r;
    squares += r * r;
  }
  const auto count = static_cast<double>(patch.rim.size());
  sphere.radius = sum / count;
  sphere.deviation =
      std::sqrt(std::max(0.0, squares / count - sphere.radius * sphere.radius)) / sphere.radius;
  sphere.axis = area_vector.normalized() * (s < 0 ? -1 : 1);
  sphere.height = (sphere.center - middle).dot(sphere.axis);
  if (!(sphere.radius < most_radius * radius_of_rim(patch, middle))) {
    return {};
  }
  return sphere;
}

bool PatchBound::is_exceeded(const Points& X, Index first) const {
  const auto rows = X.bottomRows(X.rows() - first);
  return rows.rows() > 0 &&
         !((rows.rowwise() - center.transpose()).rowwise().norm().maxCoeff() <= reach);
}

double patch_area(const Patch& patch) {
  return triangle_areas(patch.X, patch.net.triangles()).sum();
}

PatchBound bound_of(const Patch& patch) {
  PatchBound bound;
  bound.center = middle_of_rim(patch);
  bound.reach = radius_of_rim(patch, bound.center);
  bound.area = patch_area(patch);
  const std::optional<RimSphere> sphere = fit_rim_sphere(patch);
  if (sphere && sphere->is_deep()) {
    bound.reach = std::max(bound.reach, sphere->radius + sphere->height);
    bound.area = std::max(bound.area, sphere->missing_area());
  }
  bound.reach *= most_reach;
  bound.area *= most_area;
  return bound;
}

bool lift_to(const RimSphere& sphere, Patch& patch) {
  const Vec3 pole = sphere.center - sphere.radius * sphere.axis;
  Points lifted = patch.X;
  for (Index v = patch.own_from; v < patch.size(); ++v) {
    const Vec3 ray = patch.X.row(v).transpose() - pole;
    const double ahead = ray.dot(sphere.axis);
    if (!(ahead > 0)) {
      return false;
    }
    lifted.row(v) = pole + 2 * sphere.radius * ahead / ray.squaredNorm() * ray;
  }
  patch.X = lifted;
  return true;
}

}  // namespace ibmfair
