// The options of the flow, and the report that it returns.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/solve/cholesky.h"

namespace ibmfair {

class JacobianSolver;
struct JacobianShape;

/// Makes a solver for the Jacobian of a flow, and writes the solver's name to the flow's report.
using SolverMaker = std::function<std::unique_ptr<JacobianSolver>(const JacobianShape& shape)>;

/// The inner product of the gradient flow: lumped vertex mass (results independent of the
/// sampling, time has unit length^4; the vertex valences, if they are the mass matrix of the
/// energy) or identity ([W07]; time has unit length^2).
enum class Metric : std::uint8_t { mass, identity };

/// How noise is removed before a flow that keeps creases (flow/first_stage.h): by a short flow that
/// keeps only the sharpest hinges, or by a guided filter of the triangles' normals
/// (mesh/guided_normals.h), which leaves less where the noise is strong.
enum class FirstStage : std::uint8_t { flow, normals };

/// The stages of solving a linear system that may take long, for progress messages.
enum class FlowStage : std::uint8_t { analyse, factor, solve };
using StageObserver = std::function<void(FlowStage)>;

struct FlowOptions {
  std::string laplacian = "crouzeix-raviart";  ///< a name from bending_models()
  bool mass = true;                            ///< with the mass matrix in the energy
  std::string mass_matrix = {};  ///< one of the Laplacian's mass matrices; empty: its default
  std::vector<MaterialDirection> material_directions = {};  ///< #F or empty: EnergyOptions
  /// A hinge is an edge with its two triangles. Hinges whose normals differ by more than this angle
  /// (radians) hardly bend, which keeps creases; 0: all hinges bend.
  double sharp_angle = 0;
  Eigen::VectorXd spontaneous_curvature = {};  ///< H0, #V or empty: EnergyOptions
  /// A factor of the cut-off wavelength for each vertex, #V, or empty for 1 everywhere: the time of
  /// a vertex runs faster by the fourth power of its factor. The factors of vertices that are not
  /// fixed must be positive and finite.
  Eigen::VectorXd cutoff_factor = {};
  bool keep_volume = false;  ///< keep the volume of a closed mesh exactly
  bool keep_area = false;    ///< keep the area of a closed mesh exactly
  Metric metric = Metric::mass;
  int steps = 16;             ///< time steps of equal length in the total time; at least 1
  double total_time = 0;      ///< in the flow's unit; positive
  int newton_iterations = 1;  ///< per step; 1 is the semi-implicit scheme
  bool guarded = true;        ///< false: the scheme of [W07] as published
  /// Make a sweep of tangential relaxation after each guarded step. If the mesh has needles
  /// (triangles with an angle below one degree), also relax their corners before the first step.
  bool relax = true;
  bool relax_along_creases = false;  ///< no relaxation across creases, even blunt ones that bend
  double relaxation = 1;             ///< factor of the moves of tangential relaxation, 0 to 1
  bool relax_first = true;  ///< the value of `relax` for the first stage (flow/first_stage.h)
  FirstStage first_stage = FirstStage::flow;
  /// The largest distance of a vertex from its start, length.
  double max_move = std::numeric_limits<double>::infinity();
  std::string solver = "auto";   ///< a name from jacobian_backends(), or "auto"
  SolverMaker make_solver = {};  ///< makes the solver in place of the table of backends
  /// The relative residual at which iterative solvers stop; below 1. Below 1e-4, factorizations use
  /// float64.
  double solver_tolerance = 0.05;
  double memory_limit = std::numeric_limits<double>::infinity();  ///< of the whole process, bytes
  StageObserver on_stage = {};  ///< called when a stage begins that may take long
  int twicing = 0;  ///< how often the residual is smoothed and added back: flow/passes/twicing.h
  bool put_back_slides = false;  ///< twicing also adds back moves within the surface
  /// At the end of a guarded flow, finish the regions that were damped, and unfold triangles that
  /// noise has folded over (flow/passes/clean_up.h, and with creases
  /// flow/passes/residual_spikes.h).
  bool clean_up = true;

  /// Throws BadOption if a value cannot be used.
  void validate() const;

  /// The number of backward Euler steps in which a pass of twicing smooths the residual; more steps
  /// change the result little.
  int twicing_steps() const;

  /// The number of linear systems to solve: one per step, and those of twicing if all its passes
  /// share one Jacobian.
  int solves() const { return steps + (put_back_slides ? twicing * twicing_steps() : 0); }

  /// The options of the bending energy.
  EnergyOptions energy_options() const;

  /// Whether the metric is the number of triangles at each vertex.
  bool counts_valence() const;

  /// Whether the energy has no unit, as with a mass matrix that measures area; otherwise the energy
  /// has unit length^2.
  bool energy_is_dimensionless() const;
};

/// One accepted step.
struct StepRecord {
  int step = 0;                ///< counted from 1
  double time = 0;             ///< flow time after the step, in the flow's unit
  double time_step = 0;        ///< length of this step, in the flow's unit
  double energy = 0;           ///< after the step
  double gradient_norm = 0;    ///< before the step: sqrt(<g, D^-1 g>), the speed of the flow
  double largest_move = 0;     ///< the largest move of a vertex in this step, length
  double decrease_ratio = 0;   ///< actual over predicted decrease, before relaxation
  bool refactored = false;     ///< the Jacobian was factored for this step
  std::int64_t held_back = 0;  ///< vertices whose move was shortened or withheld
};

/// The predicted cost of solving the linear systems of a flow.
struct SolverForecast {
  double seconds = 0;         ///< for all steps, on one core
  double bytes = 0;           ///< in addition to the memory of the mesh
  double factor_entries = 0;  ///< nonzeros of the triangular factor; 0 without a factorization
};

struct BackendForecast {
  std::string_view solver;
  SolverForecast forecast;
};

enum class FlowStatus : std::uint8_t {
  completed,    ///< the total time was reached
  interrupted,  ///< the observer asked to stop
  stalled,      ///< before the total time was reached, no step lowered the energy any more
  diverged,     ///< unguarded only: the energy is no longer finite; X is the last finite state
};

/// Seconds of wall time spent in each part.
struct FlowSeconds {
  double assemble = 0, analyse = 0, factor = 0, gradient = 0, solve = 0, guard = 0, relax = 0;
  double other = 0;  ///< binding the energy to the mesh, and everything not listed above

  double named() const { return assemble + analyse + factor + gradient + solve + guard + relax; }
  void add(const FlowSeconds& more);
};

struct FlowReport {
  FlowStatus status = FlowStatus::completed;
  double energy_before = 0, energy_after = 0;  ///< over the stencils that touch a free vertex
  double time_reached = 0;
  std::int64_t unknowns = 0;
  std::string solver;  ///< the name of the last backend in use
  int solves = 0, factorizations = 0, rejected = 0, shortened_relaxations = 0;
  int iterations = 0;          ///< total number of conjugate gradient iterations
  int twicings = 0;            ///< completed passes of twicing
  std::int64_t caught_up = 0;  ///< vertices in damped regions that were finished at the end
  std::int64_t unfolded = 0;   ///< vertices moved to remove foldovers and residual spikes
  FactorForecast forecast;
  FlowSeconds seconds;
  std::vector<StepRecord> steps;

  /// Adds the counts and seconds of another flow, but not its step records, to this report.
  void add_effort(const FlowReport& more);
};

/// Called after each step; returning false ends the flow there. The steps of a first stage
/// (flow/first_stage.h) have the number and the time 0.
using StepObserver = std::function<bool(const StepRecord&)>;

}  // namespace ibmfair
