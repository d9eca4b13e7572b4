#include "ibmfair/fill/crease_joints.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "ibmfair/base/angle.h"

namespace ibmfair {
namespace {

// The largest angles between the direction of a crease's end and the curve that continues it.
constexpr double most_turn_of_curve = radians(60.0);
constexpr double most_turn_to_corner = radians(25.0);
constexpr double cost_of_corner = 0.02;         // radians^2: a corner must be better by this
constexpr double cost_of_single = 0.6;          // radians^2: of an end that is not continued
constexpr int rounds = 6;                       // of the search for the place where curves meet
constexpr double least_spread = 0.05;           // of the lines that determine a corner
constexpr double longest_turn = radians(80.0);  // along which a circle is continued

double squared(double x) {
  return x * x;
}

}  // namespace

double JointChoice::curve_cost(Index i, Index j) const {
  const CurveEnd &a = rim_.ends[i].curve, &b = rim_.ends[j].curve;
  const Deviation at_a = deviation(a, b.position), at_b = deviation(b, a.position);
  return std::max(at_a.angle, at_b.angle) < most_turn_of_curve
             ? at_a.cost + at_b.cost
             : std::numeric_limits<double>::infinity();
}

Index JointChoice::arc_before(Index end) const {
  return end > 0 ? end - 1 : static_cast<Index>(rim_.ends.size()) - 1;
}

/// The point nearest to the lines, and to the planes of the flat sheets beside them: minimises the
/// sum of squared distances. None if it is not determined.
std::optional<Vec3> JointChoice::meeting_point(const std::vector<Index>& ends,
                                               const std::vector<CurvePoint>& lines) const {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  for (const CurvePoint& line : lines) {
    const Eigen::Matrix3d P =
        Eigen::Matrix3d::Identity() - line.direction * line.direction.transpose();
    A += P;
    b += P * (line.position - middle_);
  }
  for (const Index end : ends) {
    for (const Index arc : {arc_before(end), end}) {
      if (const auto& plane = rim_.arcs[arc].plane) {
        A += plane->normal * plane->normal.transpose();
        b += plane->normal * plane->normal.dot(plane->point - middle_);
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A);
  if (!(eigen.eigenvalues()[0] > least_spread)) {
    return std::nullopt;
  }
  return Vec3(middle_ + eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                            eigen.eigenvectors().transpose() * b);
}

/// `curved`: the ends are continued along circles, not along lines.
std::optional<JointChoice::Corner> JointChoice::corner(const std::vector<Index>& ends,
                                                       bool curved) const {
  std::vector<CurvePoint> lines;
  lines.reserve(ends.size());
  for (const Index end : ends) {
    lines.push_back({rim_.ends[end].curve.position, rim_.ends[end].curve.direction});
  }
  std::optional<Vec3> point = meeting_point(ends, lines);
  for (int round = 0; curved && point && round < rounds; ++round) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const CurveEnd& end = rim_.ends[ends[i]].curve;
      const Circle circle(end);
      const double bend = end.curvature.norm(), chord = (*point - end.position).norm();
      const double distance = circle.distance_of_chord(chord);
      lines[i] = circle.at(bend * distance > longest_turn ? longest_turn / bend : distance);
    }
    point = meeting_point(ends, lines);
  }
  if (!point || !((*point - middle_).norm() <= reach_)) {
    return std::nullopt;
  }
  Corner result{*point, cost_of_corner};
  for (const Index end : ends) {
    const CurveEnd& curve = rim_.ends[end].curve;
    const Deviation turn = deviation(curve, *point);
    if (!(turn.angle < most_turn_to_corner)) {
      return std::nullopt;
    }
    result.cost += turn.cost;
  }
  return result;
}

std::optional<JointChoice::Corner> JointChoice::corner(const std::vector<Index>& ends) const {
  const auto straight = corner(ends, false), curved = corner(ends, true);
  return curved && !(straight && straight->cost <= curved->cost) ? curved : straight;
}

/// The squared angles of a straight crease between two corners to the planes of the flat sheets on
/// both of its sides.
double JointChoice::link_cost(const Vec3& from, const Vec3& to, Index arc, Index other_arc) const {
  double cost = 0;
  const Vec3 direction = (to - from).normalized();
  for (const Index side : {arc, other_arc}) {
    if (const auto& plane = rim_.arcs[side].plane) {
      const double angle = std::asin(std::min(1.0, std::abs(plane->normal.dot(direction))));
      cost +=
          angle < most_turn_to_corner ? squared(angle) : std::numeric_limits<double>::infinity();
    }
  }
  return cost;
}

CreaseJoint JointChoice::best(const std::vector<Index>& ends) const {
  CreaseJoint best;
  if (ends.size() == 1) {
    return {ends, {}, 0, cost_of_single};
  }
  if (ends.size() == 2) {
    best.ends = ends;
    best.cost = curve_cost(ends[0], ends[1]);
    return best;
  }
  if (const auto one = corner(ends)) {
    best = {ends, {one->position}, ends.size(), one->cost};
  }
  for (std::size_t begin = 0; begin < ends.size(); ++begin) {
    for (std::size_t size = 2; size + 2 <= ends.size() && begin + size <= ends.size(); ++size) {
      std::vector<Index> order = ends;
      std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(begin), order.end());
      const auto middle = order.begin() + static_cast<std::ptrdiff_t>(size);
      const auto one = corner({order.begin(), middle}), two = corner({middle, order.end()});
      if (!one || !two) {
        continue;
      }
      const double cost =
          one->cost + two->cost +
          link_cost(one->position, two->position, arc_before(order[size]), arc_before(order[0]));
      if (cost < best.cost) {
        best = {order, {one->position, two->position}, size, cost};
      }
    }
  }
  return best;
}

}  // namespace ibmfair
