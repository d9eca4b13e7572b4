#include "ibmfair/solve/conjugate_gradients.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

using Quad = Eigen::Array4f;
using Sums = Eigen::Array4d;  // one per coordinate

/// Where b is zero, a coordinate is solved already.
Sums quotient(const Sums& a, const Sums& b) {
  return (b > 0).select(a / b, 0);
}

}  // namespace

int ConjugateGradients::solve(const Points& B, Points& Y, double tolerance, int most_iterations) {
  const Index n = A_.size();
  const Eigen::VectorXd& scale = A_.scale();
  x_.setZero(4, n);
  r_.setZero(4, n);
  q_.resize(4, n);
  // Float32 holds the ratios of the entries, not their unit.
  const double unit = (scale.asDiagonal() * B).cwiseAbs().maxCoeff();
  if (!(unit > 0)) {
    Y.setZero(n, 3);
    return 0;
  }
  Sums rho = parallel_sum(n, Sums(Sums::Zero()), [&](std::int64_t u) -> Sums {
    for (int c = 0; c < 3; ++c) {
      r_(c, u) = static_cast<float>(scale[u] * B(u, c) / unit);
    }
    return r_.col(u).cast<double>().square();
  });
  p_ = r_;
  const Sums enough = tolerance * tolerance * rho;
  int iterations = 0;
  while (iterations < most_iterations && (rho > enough).any()) {
    ++iterations;
    A_.apply(p_, q_);
    const Sums curvature = parallel_sum(n, Sums(Sums::Zero()), [&](std::int64_t u) -> Sums {
      return p_.col(u).cast<double>() * q_.col(u).cast<double>();
    });
    const Quad alpha = quotient(rho, curvature).cast<float>();
    const Sums next = parallel_sum(n, Sums(Sums::Zero()), [&](std::int64_t u) -> Sums {
      x_.col(u) += alpha * p_.col(u);
      const Quad r = r_.col(u) - alpha * q_.col(u);
      r_.col(u) = r;
      return r.cast<double>().square();
    });
    const Quad beta = quotient(next, rho).cast<float>();
    parallel_for(n, [&](std::int64_t u) { p_.col(u) = r_.col(u) + beta * p_.col(u); });
    rho = next;
  }
  Y.resize(n, 3);
  parallel_for(n, [&](std::int64_t u) {
    for (int c = 0; c < 3; ++c) {
      Y(u, c) = unit * scale[u] * x_(c, u);
    }
  });
  return iterations;
}

}  // namespace ibmfair
