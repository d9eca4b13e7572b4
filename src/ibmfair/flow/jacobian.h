// The constant Jacobian of the flow, J = D + h S(X_ref): assembled, factored and solved with. It is
// inexact by design ([W07] section 3.2), so float32 does for its factor as long as solves are good
// to a part in a thousand; where they are not, float64 takes over.
#pragma once

#include <cstdint>
#include <optional>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/solve/cholesky.h"

namespace ibmfair {

/// J restricted to the unknown vertices: symmetric positive definite for every h > 0.
class Jacobian {
 public:
  /// Builds the pattern; analyses it at the first `refactor`.
  Jacobian(BendingEnergy& energy, const Topology& topology, const Unknowns& unknowns,
           const FlowOptions& options, FlowReport& report);

  /// Takes `X` as the reference and `h` as the time step; assembles and factors. Throws
  /// FactorizationFailed, OutOfMemory. With `directions` n (a unit vector or zero for each unknown)
  /// every vertex may move along its own only: J then acts on lengths, J_ij <n_i, n_j>.
  void refactor(const Points& X, double h, const Points* directions = nullptr);

  /// Y = J^-1 B, one row per unknown.
  void solve(const Points& B, Points& Y);

  double time_step() const { return h_; }

  /// The metric D at the reference times the damping, one entry per unknown.
  const Eigen::VectorXd& metric() const { return D_; }

  /// Factors of D, one per unknown, at least 1: a heavier vertex follows the flow more slowly.
  /// Used by the next `refactor`.
  Eigen::VectorXd& damping() { return damping_; }
  const Eigen::VectorXd& damping() const { return damping_; }

 private:
  void restrict_to(const Points& directions);
  void factor(Precision precision);

  BendingEnergy& energy_;
  const Topology& topology_;
  const Unknowns& unknowns_;
  const FlowOptions& options_;
  FlowReport& report_;
  HessianAssembler assembler_;
  SymmetricMatrix J_;
  StencilWeights weights_;
  Eigen::VectorXd D_, damping_;
  double h_ = 0;
  Precision precision_ = Precision::float32;
  bool tried_ = false;  // the factor has solved well
  std::optional<SymbolicCholesky> symbolic_;
  std::optional<CholeskyFactor> factor_;
  std::optional<CholeskySolver> solver_;
};

}  // namespace ibmfair
