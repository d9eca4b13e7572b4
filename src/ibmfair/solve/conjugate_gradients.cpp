#include "ibmfair/solve/conjugate_gradients.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/conjugate_gradients_kernels.h"

namespace ibmfair {
int ConjugateGradients::solve(const Points& B, Points& Y, double tolerance, int most_iterations) {
  const Index n = J_.size();
  const Eigen::VectorXf& N = J_.inverse_diagonal();
  x_.setZero(4, n);
  r_.setZero(4, n);
  p_.resize(4, n);
  q_.resize(4, n);
  // Float32 holds the ratios of the entries, not their unit.
  const double unit = B.size() > 0 ? B.cwiseAbs().maxCoeff() : 0;
  if (!(unit > 0)) {
    Y.setZero(n, 3);
    return 0;
  }
  double rho = parallel_sum(n, [&](std::int64_t u) {
    for (int c = 0; c < 3; ++c) {
      r_(c, u) = static_cast<float>(B(u, c) / unit);
    }
    p_.col(u) = N[u] * r_.col(u);
    return static_cast<double>((r_.col(u) * p_.col(u)).sum());
  });
  const double enough = tolerance * tolerance * rho;
  int iterations = 0;
  while (iterations < most_iterations && rho > enough) {
    ++iterations;
    const double curvature = J_.apply(p_, q_);
    if (!(curvature > 0)) {
      break;  // what is left of the residual is rounding
    }
    const auto alpha = static_cast<float>(rho / curvature);
    const double next = parallel_block_sum(n, 0.0, [&](std::int64_t first, std::int64_t last) {
      return step_residual(alpha, q_.data(), N.data(), r_.data(), {first, last});
    });
    const auto beta = static_cast<float>(next / rho);
    parallel_blocks(n, [&](std::int64_t first, std::int64_t last) {
      step_solution(alpha, beta, r_.data(), N.data(), x_.data(), p_.data(), {first, last});
    });
    rho = next;
  }
  Y.resize(n, 3);
  const double back = unit / J_.unit();
  parallel_for(n, [&](std::int64_t u) {
    for (int c = 0; c < 3; ++c) {
      Y(u, c) = back * x_(c, u);
    }
  });
  return iterations;
}

}  // namespace ibmfair
