// The constant Jacobian of the flow, J = D + h S(X_ref): linearised at a state, then solved with.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/jacobian_solver.h"
#include "ibmfair/flow/mesh_parts.h"

namespace ibmfair {

/// J restricted to the unknown vertices: symmetric positive definite for every h > 0.
class Jacobian {
 public:
  /// Everything referred to must outlive it; `start` is where the vertices are at first, #V x 3.
  Jacobian(const Points& start, BendingEnergy& energy, const Topology& topology,
           const Unknowns& unknowns, const FlowOptions& options, const MeshParts& parts,
           FlowReport& report);

  /// Takes `X` as the reference and `h` as the time step. Throws FactorizationFailed, OutOfMemory.
  /// The first call chooses the backend where the options leave that open; then one that has no
  /// factor also follows one whose factorizations keep failing, and one that has a factor follows
  /// one whose solves take too many iterations.
  void refactor(const Points& X, double h);

  /// Takes the metric at `X`, as `refactor` does, too.
  void update_metric(const Points& X);

  /// What each backend is predicted to take. Notes in the report which one `refactor` would choose;
  /// throws what it would throw.
  std::vector<BackendForecast> forecasts(const Points& X, double h);

  /// Y = J^-1 B, one row per unknown.
  void solve(const Points& B, Points& Y);

  /// J^-1 b for a number at each unknown.
  Eigen::VectorXd solve(const Eigen::VectorXd& b);

  /// After the first `refactor`: from now on to a residual of no more than `tolerance`.
  void tighten(double tolerance) { solver_->tighten(tolerance); }

  double time_step() const { return h_; }

  /// The metric D, where it was last taken, times the damping: one entry per unknown.
  const Eigen::VectorXd& metric() const { return D_; }

  /// Factors of D, one per unknown, at least 1: a heavier vertex follows the flow more slowly.
  /// Used by the next `refactor`.
  Eigen::VectorXd& damping() { return damping_; }
  const Eigen::VectorXd& damping() const { return damping_; }

 private:
  JacobianParts linearise(const Points& X, double h);
  JacobianShape shape() const;
  void choose_solver(const JacobianParts& parts);
  void take(const JacobianBackend& backend);
  bool solve_before_rival(const Points& B, Points& Y);
  void factor_instead();

  const Points& start_;
  BendingEnergy& energy_;
  const Topology& topology_;
  const StencilTerms terms_;
  const Unknowns& unknowns_;
  const FlowOptions& options_;
  const MeshParts& parts_;
  FlowReport& report_;
  std::unique_ptr<JacobianSolver> solver_;
  StencilWeights weights_;
  Eigen::VectorXd D_, damping_;
  double h_ = 0;
  int failures_ = 0;
  bool settled_ = false;                    // on this backend, whatever it takes
  const JacobianBackend* rival_ = nullptr;  // with a factor, to take over where solves take long
  IterationForecast iterations_;            // of a solve without one
  double grace_ = std::numeric_limits<double>::infinity();  // seconds that solves may take longer
};

}  // namespace ibmfair
