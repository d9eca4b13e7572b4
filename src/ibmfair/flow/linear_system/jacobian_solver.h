// The interface of solvers for systems with the Jacobian J = D + h S. A new solver ("backend") is
// one new file and one row in the table of jacobian_backends.cpp.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "ibmfair/base/version.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"

namespace ibmfair {

/// The parts of a Jacobian J = D + h S.
struct JacobianParts {
  const StencilWeights& weights;  ///< the stencils' coefficients and weights, which make up S
  const Eigen::VectorXd& D;       ///< one positive entry per unknown
  double h;                       ///< positive
};

/// Solves systems with one Jacobian after another, all with the same stencils.
class JacobianSolver {
 public:
  JacobianSolver() = default;
  JacobianSolver(const JacobianSolver&) = delete;
  JacobianSolver& operator=(const JacobianSolver&) = delete;
  virtual ~JacobianSolver() = default;

  /// Replaces the Jacobian by another one with the same stencils. Throws FactorizationFailed,
  /// OutOfMemory.
  virtual void update(const JacobianParts& parts) = 0;

  /// Y = J^-1 B, one row per unknown; Y and B must be different objects. Iterative solvers use the
  /// old content of Y, such as the previous step, as their first search direction if it has as many
  /// rows, and leave a relative residual of `FlowOptions::solver_tolerance`. That is enough because
  /// the Jacobian is not exact either, and the next step removes the rest. On noisy tori a fiftieth
  /// of the default tolerance gives the same root mean square error to within a per cent; with
  /// twice the default, a model with needles kept a sixth more of its energy.
  virtual void solve(const Points& B, Points& Y) = 0;

  /// Solves like `solve`, and subtracts the estimated seconds of the solve on one core (from the
  /// iteration count, not from a clock) from `seconds`. Returns false, without a solution in Y, if
  /// `seconds` is too short.
  virtual bool solve_within(double& /*seconds*/, const Points& B, Points& Y) {
    solve(B, Y);
    return true;
  }

  /// From now on iterative solvers leave a relative residual of at most `tolerance`.
  virtual void tighten(double /*tolerance*/) {}
};

/// The input of a backend that stays constant; all of it must outlive the backend.
struct JacobianShape {
  const Points& start;  ///< positions at the start of the flow, #V x 3
  const StencilTerms& terms;
  const Unknowns& unknowns;
  const FlowOptions& options;
  FlowReport& report;  ///< the backend adds its counts and times

  /// Reports the beginning of a stage.
  void tell(FlowStage stage) const {
    if (options.on_stage) options.on_stage(stage);
  }

  /// At least one: guarded flows may need more solves than planned.
  int solves_left() const { return std::max(1, options.solves() - report.solves); }
};

/// The estimated number of conjugate gradient iterations of a solve that starts from zero, with the
/// diagonal as preconditioner, to the default tolerance.
struct IterationForecast {
  double of_cutoff = 0;   ///< increases with the cut-off wavelength
  double of_needles = 0;  ///< additional iterations due to needles, for any cut-off

  double all() const { return of_cutoff + of_needles; }
};

/// A row of the table of backends.
struct JacobianBackend {
  std::string_view name;     ///< the value of the command line option
  std::string_view summary;  ///< for the description of the option
  std::unique_ptr<JacobianSolver> (*make)(const JacobianShape& shape);
  /// The predicted cost of the remaining solves; `iterations` is the number of iterations that each
  /// of them would take without a factorization.
  SolverForecast (*forecast)(const JacobianShape& shape, const IterationForecast& iterations);
  bool has_factor;
  /// Loads what the backend needs besides this library, and returns the versions; null if that is
  /// nothing. Throws BadOption if something is missing, OutOfMemory if there is no room for it.
  std::vector<Component> (*load)() = nullptr;

  /// Whether everything that the backend needs can be loaded.
  bool is_present() const;
};

/// Estimates the iterations per solve for a Jacobian with these parts.
IterationForecast forecast_iterations(const JacobianShape& shape, const JacobianParts& parts);

/// All backends; options.solver names one of them, or "auto".
std::span<const JacobianBackend> jacobian_backends();

/// The backend called `name`. Throws BadOption, with the names of all backends, if there is none.
const JacobianBackend& jacobian_backend(std::string_view name);

/// The backend of the scheme as published [W07], which factors the Jacobian once: CHOLMOD, or the
/// multifrontal method where there is no CHOLMOD.
const JacobianBackend& backend_as_published();

/// The backend that options.solver names. For "auto": if the flow is not guarded,
/// backend_as_published(); otherwise, among the backends that fit into memory, the
/// backend with the least predicted time for a Jacobian with these parts. Backends without
/// factorization get a bonus, because they can be replaced during the flow. Throws OutOfMemory if
/// the named backend does not fit, or for "auto" if no backend fits.
const JacobianBackend& choose_backend(const JacobianShape& shape, const JacobianParts& parts);

/// A backend with (`has_factor`) or without factorization to replace the present one; null if the
/// options name a backend or if no such backend fits into memory. Triangles with angles below 1e-8
/// make factorizations fail, but not the differences of coordinates that a backend without
/// factorization computes.
const JacobianBackend* other_backend(const JacobianShape& shape, bool has_factor);

}  // namespace ibmfair
