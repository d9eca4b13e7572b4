#include "ibmfair/flow/steps/move_bound.h"

#include <algorithm>

namespace ibmfair {

Vec3 MoveBound::within(Index v, const Vec3& p) const {
  const Vec3 centre = start_.row(v);
  Vec3 offset = p - centre;
  if (!(offset.norm() > radius_)) {
    return p;
  }
  offset *= radius_ / offset.norm();
  // Rounding may leave the scaled point outside of the ball, by one unit in the last place or, far
  // from the origin, by many; the bound is a promise all the same.
  Vec3 reached = centre + offset;
  for (double gap = std::numeric_limits<double>::epsilon(); (reached - centre).norm() > radius_;
       gap *= 2) {
    reached = centre + (1 - std::min(gap, 1.0)) * offset;
  }
  return reached;
}

bool MoveBound::stops(Index v, const Vec3& x, const Vec3& direction) const {
  constexpr double contact = 1e-6;  // relative to the radius; above rounding errors
  const Vec3 offset = x - start_.row(v).transpose();
  return offset.norm() >= (1 - contact) * radius_ && direction.dot(offset) > 0;
}

}  // namespace ibmfair
