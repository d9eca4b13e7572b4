// A bound on how far vertices get from where they started.
#pragma once

#include <cstdint>
#include <limits>

#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// Each unknown vertex stays in a closed ball about its start.
class MoveBound {
 public:
  /// `radius` is positive, or infinite for no bound; `start` outlives it.
  MoveBound(const Points& start, double radius) : start_(start), radius_(radius) {}

  bool bounds() const { return radius_ < std::numeric_limits<double>::infinity(); }

  /// The point of the ball of vertex v in the direction of p: p itself where it lies inside.
  Vec3 within(Index v, const Vec3& p) const;

  /// Whether vertex v stands on its ball at x and `direction` leads out of it.
  bool stops(Index v, const Vec3& x, const Vec3& direction) const;

 private:
  const Points& start_;
  double radius_;
};

}  // namespace ibmfair
