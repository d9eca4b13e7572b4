#include "ibmfair/flow/move_bound.h"

namespace ibmfair {

Vec3 MoveBound::within(Index v, const Vec3& p) const {
  const Vec3 centre = start_.row(v);
  Vec3 offset = p - centre;
  if (!(offset.norm() > radius_)) {
    return p;
  }
  // Rounding may leave the scaled point outside by a digit; the bound is a promise.
  for (double room = 1; (centre + offset - centre).norm() > radius_;
       room -= std::numeric_limits<double>::epsilon()) {
    offset *= room * radius_ / offset.norm();
  }
  return centre + offset;
}

bool MoveBound::stops(Index v, const Vec3& x, const Vec3& direction) const {
  constexpr double contact = 1e-6;  // of the radius
  const Vec3 offset = x - start_.row(v).transpose();
  return offset.norm() >= (1 - contact) * radius_ && direction.dot(offset) > 0;
}

}  // namespace ibmfair
