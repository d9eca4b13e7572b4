// How systems with the Jacobian J = D + h S are solved. A new backend is one file and one row.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"

namespace ibmfair {

/// One Jacobian, by its parts.
struct JacobianParts {
  const StencilWeights& weights;  ///< of S
  const Eigen::VectorXd& D;       ///< one positive entry per unknown
  double h;                       ///< positive
};

class JacobianSolver {
 public:
  JacobianSolver() = default;
  JacobianSolver(const JacobianSolver&) = delete;
  JacobianSolver& operator=(const JacobianSolver&) = delete;
  virtual ~JacobianSolver() = default;

  /// Takes another Jacobian with the same stencils. Throws FactorizationFailed, OutOfMemory.
  virtual void update(const JacobianParts& parts) = 0;

  /// Y = J^-1 B, one row per unknown, Y being another place than B; iterative solvers begin along
  /// what it holds, if that has as many rows, such as the step before, and leave a residual of
  /// `FlowOptions::solver_tolerance`. The Jacobian is not exact either, and what one step leaves
  /// the next one takes. On noisy tori a fiftieth gives the same root mean square error as the
  /// default, to a per cent; with twice the default, a model with needles kept a sixth more of its
  /// energy.
  virtual void solve(const Points& B, Points& Y) = 0;

  /// As `solve`, and subtracts the seconds that it needs on one core, counted, not timed, from
  /// `seconds`; false, with Y not solved for, where these are too few.
  virtual bool solve_within(double& /*seconds*/, const Points& B, Points& Y) {
    solve(B, Y);
    return true;
  }

  /// From now on iterative solvers leave a residual of no more than `tolerance`.
  virtual void tighten(double /*tolerance*/) {}
};

/// What a backend works on; all outlive it.
struct JacobianShape {
  const Points& start;  ///< where the vertices are at first, #V x 3
  const StencilTerms& terms;
  const Unknowns& unknowns;
  const FlowOptions& options;
  FlowReport& report;  ///< counts and times are added to it

  int solves_left() const { return std::max(0, options.solves() - report.solves); }
};

/// About how many iterations a solve takes from zero with the diagonal for a preconditioner, to the
/// default tolerance.
struct IterationForecast {
  double of_cutoff = 0;   ///< more, the farther smoothing reaches
  double of_needles = 0;  ///< in addition, however far that is

  double all() const { return of_cutoff + of_needles; }
};

/// A row of the table of backends.
struct JacobianBackend {
  std::string_view name;     ///< as the command line takes it
  std::string_view summary;  ///< one line
  std::unique_ptr<JacobianSolver> (*make)(const JacobianShape& shape);
  /// For the solves that are left, where each of them takes about so many iterations without a
  /// factor.
  SolverForecast (*forecast)(const JacobianShape& shape, const IterationForecast& iterations);
  bool has_factor;
};

/// For a Jacobian of these parts.
IterationForecast forecast_iterations(const JacobianShape& shape, const JacobianParts& parts);

/// All backends; options.solver names one of them, or "auto".
std::span<const JacobianBackend> jacobian_backends();

/// The backend of that name; throws BadOption, naming those there are.
const JacobianBackend& jacobian_backend(std::string_view name);

/// The backend that options.solver names; for "auto", of those that fit into the memory the one
/// that is predicted to take the least time for a Jacobian of these parts, those without a factor
/// less of it, as they can be left. Throws OutOfMemory where the named one, or none of them, fits.
const JacobianBackend& choose_backend(const JacobianShape& shape, const JacobianParts& parts);

/// A backend with a factor, or one without, to go on with where the options leave the choice open
/// and it fits; else null. Triangles with angles below 1e-8 are too much for a factor, not for the
/// differences that a backend without one takes.
const JacobianBackend* other_backend(const JacobianShape& shape, bool has_factor);

}  // namespace ibmfair
