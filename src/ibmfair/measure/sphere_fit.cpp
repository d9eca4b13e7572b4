#include "ibmfair/measure/sphere_fit.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "ibmfair/base/errors.h"

namespace ibmfair {

namespace {

// The algebraic fit: |x|^2 = 2 <c, x> + constant in the least-squares sense, for centred x.
Vec3 algebraic_center(const Points& X) {
  const Eigen::Matrix3d covariance = X.transpose() * X;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  if (!(axes.eigenvalues()[0] > 1e-20 * axes.eigenvalues()[2])) {
    throw BadMesh("no sphere can be fitted: the vertices lie in a plane");
  }
  return 0.5 * covariance.ldlt().solve(X.transpose() * X.rowwise().squaredNorm());
}

double variance(const Points& X, const Vec3& center) {
  const Eigen::VectorXd distance = (X.rowwise() - center.transpose()).rowwise().norm();
  return (distance.array() - distance.mean()).square().mean();
}

// With the radius eliminated (it is the mean distance), residual i is |x_i - c| minus the mean
// distance, and its derivative with respect to c is the mean unit direction minus the unit
// direction to x_i.
Vec3 gauss_newton_step(const Points& X, const Vec3& center) {
  Points direction = X.rowwise() - center.transpose();
  Eigen::VectorXd residual = direction.rowwise().norm();
  direction.rowwise().normalize();
  residual.array() -= residual.mean();
  const Eigen::RowVector3d mean_direction = direction.colwise().mean();
  direction.rowwise() -= mean_direction;
  return (direction.transpose() * direction).ldlt().solve(direction.transpose() * residual);
}

}  // namespace

SphereFit fit_sphere(const Points& X) {
  if (X.rows() < 4) {
    throw BadMesh("no sphere can be fitted: that needs four vertices at least");
  }
  // Scaled by the size of the cloud and relative to its mean, so that the squares above lose no
  // digits.
  const Eigen::RowVector3d origin = X.colwise().mean();
  Points Y = X.rowwise() - origin;
  const double size = Y.rowwise().norm().maxCoeff();
  if (!(size > 0.0 && std::isfinite(size))) {
    throw BadMesh("no sphere can be fitted: the vertices are all in one place");
  }
  Y /= size;

  constexpr int most_steps = 50;
  Vec3 center = algebraic_center(Y);
  double best = variance(Y, center);
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 next = center + gauss_newton_step(Y, center);
    const double reached = variance(Y, next);
    if (!(reached < best)) {
      break;
    }
    center = next;
    best = reached;
  }
  const double radius = (Y.rowwise() - center.transpose()).rowwise().norm().mean();
  return {origin.transpose() + size * center, size * radius, std::sqrt(best) / radius};
}

}  // namespace ibmfair
