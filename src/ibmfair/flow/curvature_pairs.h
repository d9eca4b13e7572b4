// Limited-memory BFGS on top of a factored Jacobian.
#pragma once

#include <deque>
#include <functional>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Remembers how the gradient changed over the last steps, and corrects the direction that a
/// constant Jacobian gives by it (Nocedal and Wright, Numerical Optimization, algorithm 7.4).
class CurvaturePairs {
 public:
  /// A step and the change of the gradient over it. Left out where the energy is not convex along
  /// the step, so that directions stay descent directions.
  void add(const Points& step, const Points& gradient_change);

  void forget() { pairs_.clear(); }

  /// -H g with the inverse Hessian H that `solve` (y = J^-1 b) approximates.
  Points direction(const Points& gradient, const std::function<Points(const Points&)>& solve) const;

 private:
  struct Pair {
    Points step, change;
    double curvature;  // <step, change>
  };
  std::deque<Pair> pairs_;
};

}  // namespace ibmfair
