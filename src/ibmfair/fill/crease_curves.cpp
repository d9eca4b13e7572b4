#include "ibmfair/fill/crease_curves.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/angle.h"

namespace ibmfair {
namespace {

constexpr int fine_steps = 16;  // for each segment, where a length is measured
constexpr double most_segments = 100'000;
constexpr double share_of_ignored = 0.3;  // of the turn by a curvature that a line ignores
constexpr std::size_t most_span = 3;      // edges from the end of a polyline to the middle point

double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

/// (1 - cos x) / x, zero at 0.
double versine_ratio(double x) {
  return std::sin(x / 2) * sinc(x / 2);
}

int segments(double length, double spacing) {
  const double count = std::clamp(length / spacing, 1.0, most_segments);
  return std::isfinite(count) ? static_cast<int>(std::lround(count)) : 1;
}

/// The blend of a circle from the start and one from the other end, by the share of its length.
class BlendedCircles {
 public:
  BlendedCircles(const CurveEnd& start, const CurveEnd& other)
      : first_(Circle::through(start.position, start.direction, other.position)),
        second_(Circle::through(other.position, other.direction, start.position)) {
    const double chord = (other.position - start.position).norm();
    first_length_ = chord / sinc(angle_between(start.direction, other.position - start.position));
    second_length_ = chord / sinc(angle_between(other.direction, start.position - other.position));
  }

  double length() const { return std::max(first_length_, second_length_); }

  CurvePoint at(double share) const {
    const CurvePoint a = first_.at(share * first_length_);
    const CurvePoint b = second_.at((1 - share) * second_length_);
    const double weight = share * share * (3 - 2 * share), slope = 6 * share * (1 - share);
    const Vec3 velocity = (1 - weight) * first_length_ * a.direction -
                          weight * second_length_ * b.direction + slope * (b.position - a.position);
    return {(1 - weight) * a.position + weight * b.position, velocity.normalized()};
  }

 private:
  Circle first_, second_;
  double first_length_, second_length_;
};

}  // namespace

Circle::Circle(const CurveEnd& start) : start_(start), bend_(start.curvature.norm()) {}

Circle Circle::through(const Vec3& position, const Vec3& direction, const Vec3& target) {
  const Vec3 chord = target - position;
  const Vec3 across = chord - chord.dot(direction) * direction;
  return Circle({position, direction, 2 * across / chord.squaredNorm()});
}

CurvePoint Circle::at(double distance) const {
  const double turn = bend_ * distance;
  const Vec3 normal = bend_ > 0 ? Vec3(start_.curvature / bend_) : Vec3(Vec3::Zero());
  return {
      start_.position + distance * (sinc(turn) * start_.direction + versine_ratio(turn) * normal),
      std::cos(turn) * start_.direction + std::sin(turn) * normal};
}

double Circle::distance_of_chord(double chord) const {
  const double sine = std::min(1.0, chord * bend_ / 2);
  return sine < 1e-8 ? chord : 2 * std::asin(sine) / bend_;
}

CurveEnd end_of_polyline(const std::vector<Vec3>& points) {
  const Vec3& end = points.front();
  CurveEnd result{end, (end - points[1]).normalized(), Vec3::Zero()};
  Vec3 direction = Vec3::Zero(), curvature = Vec3::Zero();
  double weights = 0;
  for (std::size_t span = 1; span <= most_span && 2 * span < points.size(); ++span) {
    // An inversion about the end makes a line of the circle through the three points.
    const Vec3 u = points[span] - end, v = points[2 * span] - end;
    const Vec3 t = (v / v.squaredNorm() - u / u.squaredNorm()).normalized();
    const double weight = v.squaredNorm();
    direction += weight * t;
    curvature += weight * 2 * (u - u.dot(t) * t) / u.squaredNorm();
    weights += weight;
  }
  if (weights > 0 && direction.norm() > 0) {
    result.direction = direction.normalized();
    curvature /= weights;
    result.curvature = curvature - curvature.dot(result.direction) * result.direction;
  }
  return result;
}

CurvePoints arc_to(const CurveEnd& start, const Vec3& target, double spacing) {
  const Circle circle = Circle::through(start.position, start.direction, target);
  const double length = (target - start.position).norm() /
                        sinc(angle_between(start.direction, target - start.position));
  const int n = segments(length, spacing);
  CurvePoints points;
  for (int i = 0; i <= n; ++i) {
    points.push_back(circle.at(length * i / n));
  }
  points.back().position = target;
  return points;
}

CurvePoints blend(const CurveEnd& start, const CurveEnd& other, double spacing) {
  const BlendedCircles curve(start, other);
  const int fine = fine_steps * segments(curve.length(), spacing);
  std::vector<double> length{0};
  for (int i = 0; i < fine; ++i) {
    const Vec3 a = curve.at(double(i) / fine).position, b = curve.at(double(i + 1) / fine).position;
    length.push_back(length.back() + (b - a).norm());
  }
  const int n = segments(length.back(), spacing);
  CurvePoints points;
  for (int i = 0; i <= n; ++i) {
    const double wanted = length.back() * i / n;
    const auto after = std::clamp<std::ptrdiff_t>(
        std::ranges::upper_bound(length, wanted) - length.begin(), 1, fine);
    const double part = (wanted - length[after - 1]) / (length[after] - length[after - 1]);
    points.push_back(curve.at((static_cast<double>(after - 1) + part) / fine));
  }
  points.front().position = start.position;
  points.back().position = other.position;
  return points;
}

Deviation deviation(const CurveEnd& end, const Vec3& target) {
  const Vec3 chord = target - end.position;
  const Circle circle(end);
  const Vec3 curved = circle.at(circle.distance_of_chord(chord.norm())).position - end.position;
  const double on_line = angle_between(end.direction, chord);
  const double on_circle = angle_between(curved, chord);
  const double ignored = share_of_ignored * angle_between(curved, end.direction);
  return {std::min(on_line, on_circle),
          std::min(on_circle * on_circle, on_line * on_line + ignored * ignored)};
}

}  // namespace ibmfair
