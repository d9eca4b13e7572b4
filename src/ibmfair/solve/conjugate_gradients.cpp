#include "ibmfair/solve/conjugate_gradients.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/conjugate_gradients_kernels.h"

namespace ibmfair {
namespace {

double largest_entry(const Points& Y) {
  return Y.size() > 0 ? Y.cwiseAbs().maxCoeff() : 0;
}

double dot(const Quads& a, const Quads& b) {
  return parallel_sum(
      a.cols(), [&](std::int64_t u) { return static_cast<double>((a.col(u) * b.col(u)).sum()); });
}

/// Converts Y / unit to float32.
void to_quads(const Points& Y, double unit, Quads& q) {
  q.resize(4, Y.rows());
  parallel_for(Y.rows(), [&](std::int64_t u) {
    for (int c = 0; c < 3; ++c) {
      q(c, u) = static_cast<float>(Y(u, c) / unit);
    }
    q(3, u) = 0;
  });
}

}  // namespace

/// Starts at x = 0 with the search direction N r, where r is the residual. Returns <r, N r>.
double ConjugateGradients::begin(const Points& B, double unit) {
  const Eigen::VectorXf& N = J_.inverse_diagonal();
  to_quads(B, unit, r_);
  x_.setZero(4, r_.cols());
  p_.resize(4, r_.cols());
  q_.resize(4, r_.cols());
  return parallel_sum(r_.cols(), [&](std::int64_t u) {
    p_.col(u) = N[u] * r_.col(u);
    return static_cast<double>((p_.col(u) * r_.col(u)).sum());
  });
}

/// Moves along p to the minimum; `slope` is <p, r>. If `goes_on`, the next p is conjugate to this
/// one. Returns <r, N r>, or nothing if the remaining residual is only rounding error.
std::optional<double> ConjugateGradients::step(double slope, bool goes_on) {
  const Eigen::VectorXf& N = J_.inverse_diagonal();
  const double curvature = J_.apply(p_, q_);
  if (!(curvature > 0)) {
    return std::nullopt;
  }
  const auto alpha = static_cast<float>(slope / curvature);
  const double next =
      parallel_block_sum(J_.size(), 0.0, [&](std::int64_t first, std::int64_t last) {
        return step_residual(alpha, q_.data(), N.data(), r_.data(), {first, last});
      });
  const auto beta = static_cast<float>(goes_on ? next / slope : 0);
  parallel_blocks(J_.size(), [&](std::int64_t first, std::int64_t last) {
    step_solution(alpha, beta, r_.data(), N.data(), x_.data(), p_.data(), {first, last});
  });
  return next;
}

/// <x, b> / <x, J x>, where J x is b minus the residual.
double ConjugateGradients::length_to_minimum(const Points& B, double unit) const {
  const auto share = [&](std::int64_t u) -> Eigen::Array2d {
    Eigen::Array2d sums(0, 0);
    for (int c = 0; c < 3; ++c) {
      const double x = x_(c, u), b = B(u, c) / unit;
      sums += Eigen::Array2d(x * b, x * (b - r_(c, u)));
    }
    return sums;
  };
  const Eigen::Array2d sums =
      parallel_sum(J_.size(), Eigen::Array2d(Eigen::Array2d::Zero()), share);
  return sums[0] / sums[1];
}

int ConjugateGradients::solve(const Points& B, Points& Y, double tolerance, int most_iterations) {
  const Index n = J_.size();
  // Dividing by the largest entry brings the entries into the range of float32.
  const double unit = largest_entry(B);
  if (!(unit > 0)) {
    Y.setZero(n, 3);
    return 0;
  }
  double rho = begin(B, unit);
  const double enough = tolerance * tolerance * rho;
  int iterations = 0;
  const double unit_of_guess = Y.rows() == n ? largest_entry(Y) : 0;
  bool guessed = unit_of_guess > 0 && most_iterations > 1;
  if (guessed) {
    ++iterations;
    to_quads(Y, unit_of_guess, p_);
    const std::optional<double> next = step(dot(p_, r_), false);
    guessed = next && *next < rho;
    rho = guessed ? *next : begin(B, unit);
  }
  while (iterations < most_iterations && rho > enough) {
    ++iterations;
    const std::optional<double> next = step(rho, true);
    if (!next) {
      break;
    }
    rho = *next;
  }
  Y.resize(n, 3);
  const double back = unit / J_.unit() * (guessed ? length_to_minimum(B, unit) : 1);
  parallel_for(n, [&](std::int64_t u) {
    for (int c = 0; c < 3; ++c) {
      Y(u, c) = back * x_(c, u);
    }
  });
  return iterations;
}

}  // namespace ibmfair
