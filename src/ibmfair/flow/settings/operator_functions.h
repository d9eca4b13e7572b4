// Functions of the operator A = D^-1 S of a flow (S: the Hessian of its energy, D: the metric),
// applied to vectors. In n steps of backward Euler, the linearised flow of time T is (I + T A /
// n)^-n. A polynomial in A that is near this function on all eigenvalues (its Chebyshev series)
// needs only products with S, no linear systems, and one matrix serves for every T:
// N. J. Higham, "Functions of Matrices" (2008), section 4.4.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

/// A function of an eigenvalue (1 / flow time, at least 0).
using Response = std::function<double(double rate)>;

/// The coefficients of T_0(x), T_1(x), ... in the polynomial near `response` on [0, `largest`],
/// with x = 2 rate / largest - 1. It is 0 at the rate 0, as `response` must be, and elsewhere off
/// by at most about 1e-3. Empty if it would have more terms than `most`.
std::vector<double> chebyshev_series(const Response& response, double largest, std::size_t most);

class OperatorFunctions {
 public:
  /// `J` holds D + h S, with D as given and h = 2 / `largest`; `largest` must be at least the
  /// largest eigenvalue of A. Keeps references to J and D.
  OperatorFunctions(const JacobianRows& J, const Eigen::VectorXd& D, double largest)
      : J_(J), D_(D), largest_(largest) {}

  /// p(A) b for the polynomial p with these Chebyshev coefficients; b has one row per unknown. In
  /// float32.
  Points apply(const std::vector<double>& series, const Points& b) const;

  /// p(A) A^-1 b, which is a polynomial as well if p(0) = 0.
  Points apply_integrated(const std::vector<double>& series, const Points& b) const;

 private:
  const JacobianRows& J_;
  const Eigen::VectorXd& D_;
  const double largest_;
};

}  // namespace ibmfair
