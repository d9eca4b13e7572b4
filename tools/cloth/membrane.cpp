#include "cloth/membrane.h"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>

namespace ibmfair::cloth {
namespace {

using Gradient = Eigen::Matrix<double, 3, 2>;  // deformation gradient
using Tensor = Eigen::Matrix2d;                // symmetric: strain, stress

/// A triangle at rest, in coordinates of its own plane.
struct RestTriangle {
  double area;
  Eigen::Matrix<double, 2, 3> B;  // gradients of the hat functions of its corners
};

RestTriangle rest_triangle(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  const Vec3 along = (x1 - x0).normalized();
  const Vec3 normal = (x1 - x0).cross(x2 - x0).normalized();
  const Vec3 across = normal.cross(along);
  Tensor edges;
  edges << (x1 - x0).norm(), (x2 - x0).dot(along), 0, (x2 - x0).dot(across);
  const Tensor inverse = edges.inverse();
  RestTriangle rest;
  rest.area = edges.determinant() / 2;
  rest.B << -inverse.colwise().sum().transpose(), inverse.transpose();
  return rest;
}

/// The part of a symmetric 2 x 2 matrix with positive eigenvalues.
Tensor positive_part(const Tensor& S) {
  const double mean = S.trace() / 2, half = std::hypot((S(0, 0) - S(1, 1)) / 2, S(0, 1));
  if (mean - half >= 0) {
    return S;
  }
  if (mean + half <= 0) {
    return Tensor::Zero();
  }
  // (S - smaller eigenvalue) / (2 half) projects on the direction of the larger one.
  return (mean + half) / (2 * half) * (S - (mean - half) * Tensor::Identity());
}

class Membrane final : public EnergyTerm {
 public:
  Membrane(const Plate& plate, const BlockHessian& H)
      : F_(plate.topology.F), places_(H.places(triangle_rows(plate.topology))) {
    const double nu = plate.material.poisson;
    lambda_ = plate.material.young * nu / (1 - nu * nu);
    mu_ = plate.material.young / (2 * (1 + nu));
    const Points& X = plate.rest;
    for (const auto& t : F_.rowwise()) {
      rest_.push_back(rest_triangle(X.row(t[0]), X.row(t[1]), X.row(t[2])));
    }
    strain_.assign(rest_.size(), Tensor::Zero());
    strain_before_ = strain_;
  }

  double energy(const Points& X) override {
    double sum = 0;
    for (Index t = 0; t < F_.rows(); ++t) {
      evaluate_strain(t, deformation(X, t));
      const Tensor change = strain_[t] - strain_before_[t];
      sum += rest_[t].area *
             (stress(strain_[t]).cwiseProduct(strain_[t]).sum() +
              beta_ * stress(change).cwiseProduct(change).sum()) /
             2;
    }
    return sum;
  }

  void add_gradient(const Points& X, Points& G) override {
    for (Index t = 0; t < F_.rows(); ++t) {
      const Gradient F = deformation(X, t);
      evaluate_strain(t, F);
      const Block forces = rest_[t].area * F * (damped_stress(t) * rest_[t].B);
      for (int i = 0; i < 3; ++i) {
        G.row(F_(t, i)) += forces.col(i);
      }
    }
  }

  void add_hessian(const Points& X, HessianPart part, BlockHessian& H) override {
    for (Index t = 0; t < F_.rows(); ++t) {
      const Gradient F = deformation(X, t);
      evaluate_strain(t, F);
      const auto& B = rest_[t].B;
      const double A = rest_[t].area, rigid = (1 + beta_) * A;
      Tensor S = A * damped_stress(t);
      if (part == HessianPart::positive) {
        S = positive_part(S);
      }
      const Eigen::Matrix3d of_stress = B.transpose() * S * B, BB = B.transpose() * B;
      const Block f = F * B, FF = mu_ * rigid * F * F.transpose();
      const Index* place = &places_[std::size_t{6} * t];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) {
          Block K = BB(i, j) * FF + lambda_ * rigid * f.col(i) * f.col(j).transpose() +
                    mu_ * rigid * f.col(j) * f.col(i).transpose();
          K.diagonal().array() += of_stress(i, j);
          H.add(*place++, K);
        }
      }
    }
  }

  void start_step(const Points&, double beta) override {
    strain_.swap(strain_before_);
    beta_ = beta;
  }

 private:
  Gradient deformation(const Points& X, Index t) const {
    Gradient edges;
    edges << (X.row(F_(t, 1)) - X.row(F_(t, 0))).transpose(),
        (X.row(F_(t, 2)) - X.row(F_(t, 0))).transpose();
    return edges * rest_[t].B.rightCols<2>().transpose();
  }

  void evaluate_strain(Index t, const Gradient& F) {
    strain_[t] = (F.transpose() * F - Tensor::Identity()) / 2;
  }

  Tensor stress(const Tensor& strain) const {
    return lambda_ * strain.trace() * Tensor::Identity() + 2 * mu_ * strain;
  }

  Tensor damped_stress(Index t) const {
    return stress(strain_[t] + beta_ * (strain_[t] - strain_before_[t]));
  }

  Triangles F_;
  std::vector<Index> places_;  // six a triangle
  double lambda_, mu_;         // N/m
  double beta_ = 0;
  std::vector<RestTriangle> rest_;
  std::vector<Tensor> strain_, strain_before_;
};

}  // namespace

std::unique_ptr<EnergyTerm> bind_membrane(const Plate& plate, const BlockHessian& H) {
  return std::make_unique<Membrane>(plate, H);
}

}  // namespace ibmfair::cloth
