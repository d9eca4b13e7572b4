// The constant Jacobian of the flow, J = D + h S(X_ref): linearised at a state X_ref, then used to
// solve many linear systems.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/solve/jacobian_rows.h"

namespace ibmfair {

/// J restricted to the unknown vertices: symmetric positive definite for every h > 0.
class Jacobian {
 public:
  /// All arguments must outlive this object. `start` (#V x 3): the positions at the start of the
  /// flow.
  Jacobian(const Points& start, BendingEnergy& energy, const Topology& topology,
           const Unknowns& unknowns, const FlowOptions& options, FlowReport& report);

  /// Takes `X` as the reference and `h` as the time step. Throws FactorizationFailed, OutOfMemory.
  /// If the options leave the choice of the backend open, the first call chooses it. Later, a
  /// backend without factorization replaces a backend whose factorizations keep failing, and a
  /// backend with factorization replaces a backend whose solves take too many iterations.
  void refactor(const Points& X, double h);

  /// Evaluates the metric D at `X`. `refactor` does so as well.
  void update_metric(const Points& X);

  /// The predicted cost of each backend. Writes the name of the backend that `refactor` would
  /// choose to the report, and throws the exceptions that this choice would throw.
  std::vector<BackendForecast> forecasts(const Points& X, double h);

  /// The rows of D + h S, with both evaluated at `X`, for products instead of solves; the metric is
  /// then the one at X. Throws FactorizationFailed. The result refers to this object.
  JacobianRows rows_at(const Points& X, double h);

  /// A bound of the eigenvalues of D^-1 S, both evaluated at `X`: the largest sum of absolute
  /// values in a row (S. Gerschgorin). In 1 / the flow's unit of time; at least the smallest normal
  /// number.
  double largest_rate(const Points& X);

  /// Y = J^-1 B, one row per unknown.
  void solve(const Points& B, Points& Y);

  /// J^-1 b for a vector b with one number per unknown.
  Eigen::VectorXd solve(const Eigen::VectorXd& b);

  /// From now on, solves leave a relative residual of at most `tolerance`. Precondition: `refactor`
  /// was called.
  void tighten(double tolerance) { solver_->tighten(tolerance); }

  double time_step() const { return h_; }

  /// The metric D as last evaluated, times the damping: one entry per unknown.
  const Eigen::VectorXd& metric() const { return D_; }

  /// Factors that multiply D, one per unknown, at least 1: a heavier vertex follows the flow more
  /// slowly. The next `refactor` applies them.
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
  FlowReport& report_;
  std::unique_ptr<JacobianSolver> solver_;
  StencilWeights weights_;
  Eigen::VectorXd D_, damping_;
  double h_ = 0;
  int failures_ = 0;
  bool settled_ = false;                    // the backend is not exchanged any more
  const JacobianBackend* rival_ = nullptr;  // factors J, and takes over if solves take too long
  IterationForecast iterations_;            // of a solve without factorization
  double grace_ = std::numeric_limits<double>::infinity();  // seconds beyond the rival's, in total
};

}  // namespace ibmfair
