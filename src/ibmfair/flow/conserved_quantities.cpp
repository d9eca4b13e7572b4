#include "ibmfair/flow/conserved_quantities.h"

#include <array>
#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

struct ConservedQuantities::Quantity {
  double (*value)(const Points& X, const Triangles& F);
  /// Its derivative by the corner x of the triangle x, y, z.
  Vec3 (*derivative)(const Vec3& x, const Vec3& y, const Vec3& z);
  bool FlowOptions::*wanted;
};

namespace {

using Quantity = ConservedQuantities::Quantity;

Vec3 area_derivative(const Vec3& x, const Vec3& y, const Vec3& z) {
  return double_area_vector(x, y, z).normalized().cross(z - y) / 2;
}

/// A sixth of the double area vector: around a closed star the rest cancels.
Vec3 volume_derivative(const Vec3& x, const Vec3& y, const Vec3& z) {
  return double_area_vector(x, y, z) / 6;
}

constexpr std::array quantities{
    Quantity{enclosed_volume, volume_derivative, &FlowOptions::keep_volume},
    Quantity{surface_area, area_derivative, &FlowOptions::keep_area},
};

constexpr int most_corrections = 8;
constexpr double exact = 1e-13;  // of the target: what rounding may leave of a long sum

Points gradient_of(const Quantity& quantity, const Points& X, const Topology& topology,
                   const Unknowns& unknowns) {
  Points gradient(unknowns.size(), 3);
  parallel_for(unknowns.size(), [&](std::int64_t u) {
    const Index v = unknowns.vertex[u];
    Vec3 sum = Vec3::Zero();
    for (const Index t : topology.stars[v]) {
      const auto x = topology.F.row(t);
      const int i = x[0] == v ? 0 : x[1] == v ? 1 : 2;
      sum += quantity.derivative(X.row(x[i]), X.row(x[(i + 1) % 3]), X.row(x[(i + 2) % 3]));
    }
    gradient.row(u) = sum;
  });
  return gradient;
}

double inner(const Points& A, const Points& B) {
  return A.cwiseProduct(B).sum();
}

/// x of M x = b with M_ij = <A_i, B_j>; the shortest where the quantities depend on each other, as
/// the volume and the area of a sphere do.
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
  scaled.setThreshold(1e-6);
  scaled.compute(scale.asDiagonal() * M * scale.asDiagonal());
  return scale.asDiagonal() * scaled.solve(scale.asDiagonal() * b);
}

}  // namespace

ConservedQuantities::ConservedQuantities(const Points& X, const Topology& topology,
                                         const Unknowns& unknowns, const FlowOptions& options)
    : topology_(topology), unknowns_(unknowns) {
  for (const Quantity& quantity : quantities) {
    if (options.*quantity.wanted) {
      kept_.push_back({&quantity, quantity.value(X, topology.F)});
    }
  }
  if (!kept_.empty() && !(topology.boundary_loops.empty() && topology.orientable)) {
    throw BadMesh(topology.orientable
                      ? "volume and area can be kept on closed meshes only; this one has holes"
                      : "volume and area can be kept on meshes with two sides only");
  }
}

void ConservedQuantities::linearise(const Points& X) {
  A_.clear();
  for (const Kept& kept : kept_) {
    A_.push_back(gradient_of(*kept.quantity, X, topology_, unknowns_));
  }
}

void ConservedQuantities::constrain(Points& step, const Solve& solve) const {
  if (empty()) {
    return;
  }
  std::vector<Points> Z(A_.size());
  Eigen::VectorXd b(static_cast<Eigen::Index>(A_.size()));
  for (std::size_t i = 0; i < A_.size(); ++i) {
    solve(A_[i], Z[i]);
    b[static_cast<Eigen::Index>(i)] = inner(A_[i], step);
  }
  const Eigen::VectorXd multipliers = solve_small(A_, Z, b);
  for (std::size_t i = 0; i < A_.size(); ++i) {
    step -= multipliers[static_cast<Eigen::Index>(i)] * Z[i];
  }
}

bool ConservedQuantities::restore(Points& Y, const Eigen::VectorXd& D) const {
  std::vector<Points> directions;
  directions.reserve(A_.size());
  for (const Points& A : A_) {
    directions.emplace_back(D.cwiseInverse().asDiagonal() * A);
  }
  Eigen::VectorXd missing(static_cast<Eigen::Index>(kept_.size()));
  for (int i = 0; i < most_corrections; ++i) {
    std::vector<Points> gradients;
    bool reached = true;
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const auto& [quantity, target] = kept_[k];
      const double off = target - quantity->value(Y, topology_.F);
      missing[static_cast<Eigen::Index>(k)] = off;
      reached = reached && std::abs(off) <= exact * std::abs(target);
    }
    if (reached || !missing.allFinite()) {
      return reached;
    }
    for (const Kept& kept : kept_) {
      gradients.push_back(gradient_of(*kept.quantity, Y, topology_, unknowns_));
    }
    const Eigen::VectorXd factors = solve_small(gradients, directions, missing);
    parallel_for(unknowns_.size(), [&](std::int64_t u) {
      for (std::size_t k = 0; k < directions.size(); ++k) {
        Y.row(unknowns_.vertex[u]) += factors[static_cast<Eigen::Index>(k)] * directions[k].row(u);
      }
    });
  }
  return false;
}

}  // namespace ibmfair
