// What a user of the flow sets, and what the flow reports.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/solve/cholesky.h"

namespace ibmfair {

/// The inner product of the gradient flow: lumped vertex mass (results independent of the
/// sampling, time has unit length^4; valences where these are the energy's mass) or identity
/// ([W07]; time has unit length^2).
enum class Metric : std::uint8_t { mass, identity };

/// What a flow is at between its steps, for those who wait.
enum class FlowStage : std::uint8_t { analyse, factor, solve };
using StageObserver = std::function<void(FlowStage)>;

struct FlowOptions {
  std::string laplacian = "crouzeix-raviart";  ///< a name from bending_models()
  bool mass = true;                            ///< with the mass matrix in the energy
  std::string mass_matrix = {};  ///< one that goes with the Laplacian; empty: its default
  std::vector<MaterialDirection> material_directions = {};  ///< #F or empty: EnergyOptions
  /// Hinges that turn by more than this angle hardly bend, radians; 0: all bend.
  double sharp_angle = 0;
  Eigen::VectorXd spontaneous_curvature = {};  ///< H0, #V or empty: EnergyOptions
  /// For each vertex a factor of the wavelength up to which it is smoothed, #V or empty for 1: its
  /// time runs faster by the fourth power. Positive and finite where vertices move.
  Eigen::VectorXd cutoff_factor = {};
  bool keep_volume = false;  ///< of a closed mesh, exactly
  bool keep_area = false;    ///< of a closed mesh, exactly
  Metric metric = Metric::mass;
  int steps = 16;             ///< the total time is split evenly over them; at least 1
  double total_time = 0;      ///< in the flow's unit; positive
  int newton_iterations = 1;  ///< per step; 1 is the semi-implicit scheme
  bool guarded = true;        ///< false: the scheme of [W07] as published
  /// A sweep of tangential relaxation after each guarded step, and before the first one where there
  /// are needles.
  bool relax = true;
  bool relax_first = true;  ///< the same in the first stage, where there is one
  double max_move = std::numeric_limits<double>::infinity();  ///< from the start, length
  std::string solver = "auto";  ///< a name from jacobian_backends(), or "auto"
  /// Of the residual, for iterative solvers; below 1. Below 1e-4 factors are float64.
  double solver_tolerance = 0.05;
  double memory_limit = std::numeric_limits<double>::infinity();  ///< of the whole process, bytes
  StageObserver on_stage = {};  ///< told when a stage begins that may take long
  int twicing = 0;  ///< times that the residual is smoothed and put back: flow/twicing.h
  bool put_back_slides = false;  ///< twicing does so within the surface, too
  /// At the end of a guarded flow, what it had to leave behind is seen to: flow/mending.h, and
  /// where creases are kept flow/specks.h.
  bool mend = true;

  /// Throws BadOption where a value cannot be used.
  void validate() const;

  /// Of backward Euler, in which a pass of twicing smooths the residual; more change little.
  int twicing_steps() const;

  /// Systems to solve: one a step, and those of twicing where all its passes share one Jacobian.
  int solves() const { return steps + (put_back_slides ? twicing * twicing_steps() : 0); }

  /// What they say of the energy.
  EnergyOptions energy_options() const;

  /// Whether the metric counts triangles.
  bool counts_valence() const;

  /// Whether the energy is a number, for a mass matrix that measures area; else it is an area.
  bool energy_is_dimensionless() const;
};

/// One accepted step.
struct StepRecord {
  int step = 0;                ///< counted from 1
  double time = 0;             ///< reached, in the flow's unit
  double time_step = 0;        ///< of this step
  double energy = 0;           ///< after the step
  double gradient_norm = 0;    ///< before the step: sqrt(<g, D^-1 g>), the speed of the flow
  double largest_move = 0;     ///< of a vertex in this step, length
  double decrease_ratio = 0;   ///< actual decrease over the predicted one, before relaxation
  bool refactored = false;     ///< the Jacobian was factored for this step
  std::int64_t held_back = 0;  ///< vertices whose move was shortened or withheld
};

/// What solving the linear systems of a flow is predicted to take.
struct SolverForecast {
  double seconds = 0;         ///< on one core, in all steps
  double bytes = 0;           ///< on top of what the mesh takes
  double factor_entries = 0;  ///< 0 without a factor
};

struct BackendForecast {
  std::string_view solver;
  SolverForecast forecast;
};

enum class FlowStatus : std::uint8_t {
  completed,    ///< the total time was reached
  interrupted,  ///< the observer asked to stop
  stalled,      ///< no step, however small, lowers the energy any more; time was left
  diverged,     ///< unguarded only: the energy is no longer finite; X is the last finite state
};

/// Seconds of wall time spent in each part.
struct FlowSeconds {
  double assemble = 0, analyse = 0, factor = 0, gradient = 0, solve = 0, guard = 0, relax = 0;
  double other = 0;  ///< binding the energy to the mesh, and all that is in none of these

  double named() const { return assemble + analyse + factor + gradient + solve + guard + relax; }
  void add(const FlowSeconds& more);
};

struct FlowReport {
  FlowStatus status = FlowStatus::completed;
  double energy_before = 0, energy_after = 0;  ///< over the stencils that touch a free vertex
  double time_reached = 0;
  std::int64_t unknowns = 0;
  std::string solver;  ///< the backend that was used last
  int solves = 0, factorizations = 0, rejected = 0, shortened_relaxations = 0;
  int iterations = 0;          ///< of conjugate gradients, in all
  int twicings = 0;            ///< passes that were made
  std::int64_t caught_up = 0;  ///< vertices that flowed on where some had to be slowed down
  std::int64_t unfolded = 0;   ///< vertices that were moved where flaps or specks were
  FactorForecast forecast;
  FlowSeconds seconds;
  std::vector<StepRecord> steps;

  /// Counts what another flow took, but for its steps, as if this one had.
  void add_effort(const FlowReport& more);
};

/// Called after each step; returning false ends the flow there. The steps of a first stage
/// (flow/first_stage.h) have the number and the time 0.
using StepObserver = std::function<bool(const StepRecord&)>;

}  // namespace ibmfair
