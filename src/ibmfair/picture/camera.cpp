#include "ibmfair/picture/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "ibmfair/base/errors.h"

namespace ibmfair {
void View::validate() const {
  if (!from.allFinite() || !(from.norm() > 0.0)) {
    throw BadOption("the view direction must be a vector other than zero");
  }
  if (!up.allFinite()) {
    throw BadOption("the upward direction must be finite");
  }
  if (!(field_of_view >= 0.0 && field_of_view <= 2.0)) {
    throw BadOption("the field of view must be between 0 and 2 radians");
  }
  if (!(margin >= 0.0 && margin < 0.5)) {
    throw BadOption("the margin must be at least 0 and less than a half");
  }
}

Camera::Camera(const View& view, int width, int height, const Points& points)
    : half_width_(0.5 * width), half_height_(0.5 * height) {
  view.validate();
  back_ = view.from.normalized();
  right_ = view.up.normalized().cross(back_);
  if (!(right_.norm() > 1e-6)) {  // the view is along `up`: any perpendicular direction will do
    right_ = back_.unitOrthogonal();
  }
  right_.normalize();
  up_ = back_.cross(right_);

  const double shorter_half = std::min(half_width_, half_height_);
  usable_half_width_ = half_width_ - 2.0 * view.margin * shorter_half;
  usable_half_height_ = half_height_ - 2.0 * view.margin * shorter_half;
  if (view.field_of_view > 0.0) {
    focal_length_ = shorter_half / std::tan(0.5 * view.field_of_view);
  }

  centre_on(points);
  focal_length_ > 0.0 ? fit_perspective(points) : fit_orthographic(points);
}

Vec3 Camera::in_view(const Vec3& x) const {
  const Vec3 y = x - centre_;
  return {y.dot(right_), y.dot(up_), y.dot(back_)};
}

Vec3 Camera::in_scene(const Vec3& direction) const {
  return direction.x() * right_ + direction.y() * up_ + direction.z() * back_;
}

void Camera::centre_on(const Points& points) {
  if (points.rows() == 0) {
    return;
  }
  // A first centre near the points, so that the second one is accurate also far from the origin.
  centre_ = points.row(0);
  Eigen::AlignedBox3d box;
  for (const auto& x : points.rowwise()) {
    box.extend(in_view(x.transpose()));
  }
  centre_ += in_scene(box.center());
}

void Camera::fit_orthographic(const Points& points) {
  double across = 0.0;
  double along = 0.0;
  for (const auto& x : points.rowwise()) {
    const Vec3 y = in_view(x.transpose());
    across = std::max(across, std::abs(y.x()));
    along = std::max(along, std::abs(y.y()));
  }
  if (across > 0.0 || along > 0.0) {
    scale_ = 1.0 / std::max(across / usable_half_width_, along / usable_half_height_);
  }
}

void Camera::fit_perspective(const Points& points) {
  // A point (x, y, z) is between the margins if |x - centre| * slope <= distance - z, which is two
  // linear conditions on centre and distance, and likewise for y. The smallest feasible distance
  // follows from the largest values of z + slope * x and z - slope * x.
  if (points.rows() == 0) {
    return;
  }
  const Eigen::Array2d slope =
      focal_length_ / Eigen::Array2d(usable_half_width_, usable_half_height_);
  Eigen::Array2d right_or_up = Eigen::Array2d::Constant(-std::numeric_limits<double>::infinity());
  Eigen::Array2d left_or_down = right_or_up;
  double nearest = 0.0;
  double size = 0.0;
  for (const auto& x : points.rowwise()) {
    const Vec3 y = in_view(x.transpose());
    right_or_up = right_or_up.max(y.z() + slope * y.head<2>().array());
    left_or_down = left_or_down.max(y.z() - slope * y.head<2>().array());
    nearest = std::max(nearest, y.z());
    size = std::max(size, y.norm());
  }
  if (!(size > 0.0)) {
    return;
  }
  const Eigen::Array2d shift = 0.5 * (right_or_up - left_or_down) / slope;
  centre_ += in_scene({shift.x(), shift.y(), 0.0});
  // The viewer stays in front of all points, also of a needle that points at the viewer.
  distance_ = std::max((0.5 * (right_or_up + left_or_down)).maxCoeff(), nearest + 0.1 * size);
}

Projected Camera::project(const Vec3& x) const {
  const Vec3 y = in_view(x);
  if (focal_length_ > 0.0) {
    const double scale = focal_length_ / (distance_ - y.z());
    return {half_width_ + scale * y.x(), half_height_ - scale * y.y(), scale * distance_};
  }
  return {half_width_ + scale_ * y.x(), half_height_ - scale_ * y.y(), scale_ * y.z()};
}

Vec3 Camera::towards_viewer(const Vec3& x) const {
  return focal_length_ > 0.0 ? (centre_ + distance_ * back_ - x).normalized() : back_;
}

}  // namespace ibmfair
