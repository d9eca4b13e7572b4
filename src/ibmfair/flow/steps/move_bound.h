// A bound on the distance of vertices from their start.
#pragma once

#include <cstdint>
#include <limits>

#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// Each unknown vertex stays in a closed ball about its start.
class MoveBound {
 public:
  /// `radius` is positive, or infinite for no bound; `start` (#V x 3) must outlive this object.
  MoveBound(const Points& start, double radius) : start_(start), radius_(radius) {}

  bool bounds() const { return radius_ < std::numeric_limits<double>::infinity(); }

  /// p if it lies in the ball of vertex v, else the point of the ball in the direction of p.
  Vec3 within(Index v, const Vec3& p) const;

  /// Whether x lies on the surface of the ball of vertex v and `direction` leads out of the ball.
  bool stops(Index v, const Vec3& x, const Vec3& direction) const;

 private:
  const Points& start_;
  double radius_;
};

}  // namespace ibmfair
