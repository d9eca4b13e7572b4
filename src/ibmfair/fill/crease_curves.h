// Curves in space by which creases are continued: circular arcs, and blends of two of them. H.-J.
// Wenz, "Interpolation of curve data by blended generalized circles" (CAGD 1996). Lines and circles
// come back exactly.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A place on a curve.
struct CurvePoint {
  Vec3 position = Vec3::Zero();
  Vec3 direction = Vec3::Zero();  ///< unit tangent, along the curve
};

/// A place on a curve, and how the curve bends there.
struct CurveEnd {
  Vec3 position = Vec3::Zero();
  Vec3 direction = Vec3::Zero();  ///< unit tangent, along the curve
  Vec3 curvature = Vec3::Zero();  ///< perpendicular to `direction`, 1/length
};

/// The circle that starts with a place, a direction and a curvature. A line counts as a circle.
class Circle {
 public:
  explicit Circle(const CurveEnd& start);

  /// The circle that leaves `position` in the unit `direction` and goes on to `target`.
  static Circle through(const Vec3& position, const Vec3& direction, const Vec3& target);

  /// The place at a distance along the circle.
  CurvePoint at(double distance) const;

  /// The vector of curvature at the start, 1/length.
  Vec3 curvature() const { return start_.curvature; }

  /// The distance along the circle from its start to a chord of this length; at most a half circle.
  double distance_of_chord(double chord) const;

 private:
  CurveEnd start_;
  double bend_;  // the length of the curvature
};

/// The curve at the end of a polyline: the circle that the last points suggest. `points` (at least
/// two) begin with the end; the direction points away from the others. Points on one circle, or on
/// one line, give it exactly.
CurveEnd end_of_polyline(const std::vector<Vec3>& points);

/// Points of a curve in equal distances, of at most `spacing` about, with both ends.
using CurvePoints = std::vector<CurvePoint>;

/// The circular arc from `start` to `target`.
CurvePoints arc_to(const CurveEnd& start, const Vec3& target, double spacing);

/// The curve from one end to the other; both directions point into the curve. It bends as the
/// circles do that go on from either end and end at the other.
CurvePoints blend(const CurveEnd& start, const CurveEnd& other, double spacing);

/// How well a curve's end leads to `target`, radians.
struct Deviation {
  /// The angle by which the direction of the end would have to turn: on the circle of the end's
  /// curvature, or on a line if that fits better.
  double angle = 0;
  double cost = 0;  ///< the same, but a line costs more at an end that is curved, radians^2
};
Deviation deviation(const CurveEnd& end, const Vec3& target);

}  // namespace ibmfair
