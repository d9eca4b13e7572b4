// Limited-memory BFGS on top of a factored Jacobian.
#pragma once

#include <deque>
#include <functional>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Remembers how the gradient changed over the last steps, and uses these changes to correct the
/// search direction of a constant Jacobian (Nocedal and Wright, Numerical Optimization, algorithm
/// 7.4).
class CurvaturePairs {
 public:
  /// Adds a step and the change of the gradient over this step. The pair is dropped if the energy
  /// is not convex along the step, so that directions stay descent directions.
  void add(const Points& step, const Points& gradient_change);

  void forget() { pairs_.clear(); }

  /// -H g, with H the approximate inverse Hessian: `solve` (y = J^-1 b) corrected by the pairs.
  Points direction(const Points& gradient, const std::function<Points(const Points&)>& solve) const;

 private:
  struct Pair {
    Points step, change;
    double curvature;  // <step, change>
  };
  std::deque<Pair> pairs_;
};

}  // namespace ibmfair
