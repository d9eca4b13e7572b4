#include "ibmfair/flow/steps/conserved_quantities.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

struct ConservedQuantities::Quantity {
  double (*value)(const Points& X, const Triangles& F);
  /// The derivative of the quantity with respect to the corner x of the triangle x, y, z.
  Vec3 (*derivative)(const Vec3& x, const Vec3& y, const Vec3& z);
  bool FlowOptions::*wanted;
};

namespace {

using Quantity = ConservedQuantities::Quantity;

Vec3 area_derivative(const Vec3& x, const Vec3& y, const Vec3& z) {
  return double_area_vector(x, y, z).normalized().cross(z - y) / 2;
}

/// A sixth of the double area vector: the other terms cancel around a closed star.
Vec3 volume_derivative(const Vec3& x, const Vec3& y, const Vec3& z) {
  return double_area_vector(x, y, z) / 6;
}

constexpr std::array quantities{
    Quantity{enclosed_volume, volume_derivative, &FlowOptions::keep_volume},
    Quantity{surface_area, area_derivative, &FlowOptions::keep_area},
};

// No tuned constants: Newton's method either converges in a few corrections or not at all.
constexpr int most_corrections = 8;
constexpr double exact = 1e-13;       // relative to the target: rounding error of a long sum
constexpr double independent = 1e-6;  // least pivot: below, quantities depend on each other

Points gradient_of(const Quantity& quantity, const Points& X, const Topology& topology,
                   const Unknowns& unknowns) {
  Points gradient(unknowns.size(), 3);
  parallel_for(unknowns.size(), [&](std::int64_t u) {
    const Index v = unknowns.vertex[u];
    Vec3 sum = Vec3::Zero();
    for (const Index t : topology.stars[v]) {
      const auto [y, z] = other_corners(topology.F, t, v);
      sum += quantity.derivative(X.row(v), X.row(y), X.row(z));
    }
    gradient.row(u) = sum;
  });
  return gradient;
}

/// The change of a quantity with this gradient by rounding the coordinates. Far from the origin it
/// is larger than the rounding error of the sum.
double coarseness(const Points& gradient, const Points& X) {
  const double rounding = std::numeric_limits<double>::epsilon() * X.cwiseAbs().maxCoeff();
  return rounding * gradient.cwiseAbs().sum();
}

double inner(const Points& A, const Points& B) {
  return A.cwiseProduct(B).sum();
}

/// The solution x of M x = b with M_ij = <A_i, B_j>. If the quantities depend on each other, like
/// the volume and the area of a sphere, the shortest of the solutions.
Eigen::VectorXd solve_small(const std::vector<Points>& A, const std::vector<Points>& B,
                            const Eigen::VectorXd& b) {
  const auto count = static_cast<Eigen::Index>(A.size());
  Eigen::MatrixXd M(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      M(i, j) = inner(A[i], B[j]);
    }
  }
  const Eigen::VectorXd scale = M.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) {
    return Eigen::VectorXd::Zero(count);
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> scaled;
  scaled.setThreshold(independent);
  scaled.compute(scale.asDiagonal() * M * scale.asDiagonal());
  return scale.asDiagonal() * scaled.solve(scale.asDiagonal() * b);
}

/// Subtracts from the move d the linear combination of the Z_i that makes <A_i, d> = 0 for all i.
void subtract_part(Points& d, const std::vector<Points>& A, const std::vector<Points>& Z) {
  if (A.empty()) {
    return;
  }
  Eigen::VectorXd b(static_cast<Eigen::Index>(A.size()));
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    b[i] = inner(A[i], d);
  }
  const Eigen::VectorXd multipliers = solve_small(A, Z, b);
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    d -= multipliers[i] * Z[i];
  }
}

}  // namespace

ConservedQuantities::ConservedQuantities(const Points& X, const Topology& topology,
                                         const Unknowns& unknowns, const FlowOptions& options)
    : topology_(topology), unknowns_(unknowns) {
  for (const Quantity& quantity : quantities) {
    if (options.*quantity.wanted) {
      const double target = quantity.value(X, topology.F);
      kept_.push_back({&quantity, target, exact * std::abs(target)});
    }
  }
  if (!kept_.empty() && !(topology.boundary_loops.empty() && topology.orientable)) {
    throw BadMesh(
        topology.orientable
            ? fmt::format("--keep-volume and --keep-area need a closed mesh, and this one has open "
                          "boundaries: {} (`ibmfair fill --all` closes them)",
                          topology.boundary_loops.size())
            : std::string("--keep-volume and --keep-area need an orientable mesh, and this one has "
                          "only one side"));
  }
  linearise(X, [](const Points& B, Points& Y) { Y = B; });
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    kept_[i].rounding += coarseness(A_[i], X);
  }
}

void ConservedQuantities::suspend() {
  suspended_ = !kept_.empty();
  A_.clear();
  Z_.clear();
}

Points ConservedQuantities::resume(const Points& X, const Solve& solve) {
  suspended_ = false;
  linearise(X, solve);
  const Eigen::VectorXd factors = solve_small(A_, Z_, missing_at(X));
  Points move = Points::Zero(unknowns_.size(), 3);
  for (Eigen::Index k = 0; k < factors.size(); ++k) {
    move += factors[k] * Z_[k];
  }
  return move;
}

void ConservedQuantities::linearise(const Points& X, const Solve& solve) {
  if (empty()) {
    return;
  }
  A_.clear();
  Z_.resize(kept_.size());
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    A_.push_back(gradient_of(*kept_[i].quantity, X, topology_, unknowns_));
    solve(A_[i], Z_[i]);
  }
}

void ConservedQuantities::constrain(Points& step) const {
  subtract_part(step, A_, Z_);
}

void ConservedQuantities::speed(const Points& g, const Eigen::VectorXd& D, Points& speed) const {
  const auto over_D = [&](const Points& B, Points& Y) {
    Y.resize(B.rows(), 3);
    parallel_for(B.rows(), [&](std::int64_t u) { Y.row(u) = B.row(u) / D[u]; });
  };
  std::vector<Points> Z(A_.size());
  for (std::size_t i = 0; i < A_.size(); ++i) {
    over_D(A_[i], Z[i]);
  }
  over_D(g, speed);
  subtract_part(speed, A_, Z);
}

bool ConservedQuantities::restore(const Points& move, Points& Y) const {
  std::vector<Points> Z = Z_;
  parallel_for(unknowns_.size(), [&](std::int64_t u) {
    if ((move.row(u).array() == 0).all()) {
      for (Points& z : Z) {
        z.row(u).setZero();
      }
    }
  });
  for (int i = 0; i < most_corrections; ++i) {
    const Eigen::VectorXd missing = missing_at(Y);
    if (is_rounding(missing) || !missing.allFinite()) {
      return missing.allFinite();
    }
    std::vector<Points> gradients;
    for (const Kept& kept : kept_) {
      gradients.push_back(gradient_of(*kept.quantity, Y, topology_, unknowns_));
    }
    const Eigen::VectorXd factors = solve_small(gradients, Z, missing);
    parallel_for(unknowns_.size(), [&](std::int64_t u) {
      for (std::size_t k = 0; k < Z.size(); ++k) {
        Y.row(unknowns_.vertex[u]) += factors[static_cast<Eigen::Index>(k)] * Z[k].row(u);
      }
    });
  }
  return false;
}

Eigen::VectorXd ConservedQuantities::missing_at(const Points& Y) const {
  Eigen::VectorXd missing(static_cast<Eigen::Index>(kept_.size()));
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    missing[static_cast<Eigen::Index>(k)] =
        kept_[k].target - kept_[k].quantity->value(Y, topology_.F);
  }
  return missing;
}

bool ConservedQuantities::is_rounding(const Eigen::VectorXd& missing) const {
  bool all = true;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    all = all && std::abs(missing[static_cast<Eigen::Index>(k)]) <= kept_[k].rounding;
  }
  return all;
}

}  // namespace ibmfair
