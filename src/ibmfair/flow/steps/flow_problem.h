// The part that the plain and the guarded flow share: the state, its energy and gradient, and the
// Newton step with a constant Jacobian.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/linear_system/jacobian.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/steps/conserved_quantities.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/steps/free_rims.h"
#include "ibmfair/flow/steps/move_bound.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The state of a flow of one mesh (or of the piece of a mesh that belongs to one process), with
/// all that its steps and passes need.
class FlowProblem {
 public:
  /// All arguments must outlive the problem and must not change. The flow starts at `X` (#V x 3).
  FlowProblem(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
              const FlowOptions& options, const MeshParts& parts = MeshParts::one());

  const Topology& topology;
  const std::vector<std::uint8_t>& fixed;  ///< #V flags
  const FlowOptions& options;
  const MeshParts& parts;
  const Unknowns unknowns;
  FlowReport report;
  Points X;  ///< #V x 3, the state

  /// The positions at the start of the flow, #V x 3.
  const Points& start() const { return start_; }

  /// E_b over the stencils that touch an unknown, of all parts, at the state and at Y (#V x 3).
  double energy() const { return energy_; }
  double energy_at(const Points& Y);

  /// Whether the positions at which the energy was last evaluated, with the result `energy`, surely
  /// have no hinge in this part with a smaller dihedral angle than `angle` (radians). False means
  /// that there may be such hinges.
  bool has_no_folds(double energy, double angle = fold_angle) const;

  /// The vertices of hinges that have folded over at Y (FoldWatch::new_folds). Precondition: the
  /// energy was last evaluated at Y, with the result `energy`.
  std::vector<Index> new_folds(const FoldWatch& folds, const Points& Y, double energy) const;

  /// Evaluates the energy and its gradient at the state, unless they are known.
  void update_gradient();

  /// The energy at Y. Also stores the gradient at Y, for `move_to_tried`.
  double try_state(const Points& Y);

  /// Moves the state to Y; Y then holds the previous state.
  void move_to(Points& Y);

  /// Does the same as `move_to`, with the stored energy and gradient of `try_state`. Precondition:
  /// Y is the argument of the last call of `try_state`.
  void move_to_tried(Points& Y);

  /// The gradient at the state (by `update_gradient`), one row per unknown.
  const Points& gradient() const { return g_; }

  /// The gradient at Y, one row per unknown.
  Points gradient_at(const Points& Y);

  /// Writes the gradient at Y to `gradient` and returns the energy at Y. This costs little more
  /// than either of the two.
  double energy_and_gradient_at(const Points& Y, Points& gradient);

  /// The step of backward Euler from the state with the Jacobian's own time step, by
  /// `options.newton_iterations` inexact Newton iterations: one row per unknown, length.
  void newton_step(Points& step);

  /// Keeps only the parts along the surface's normals of moves or forces (one row per unknown) at
  /// free rims (flow/steps/free_rims.h). Gradients and Newton steps have no other parts there.
  void keep_rims(Points& rows);

  const FreeRims& rims() const { return rims_; }

  /// The move (one row per unknown) with the rows of the unknowns of other parts appended.
  const Points& with_others(const Points& move);

  /// Whether volume or area are to be restored at the end instead of kept in each step. That is so
  /// if twicing adds back whole moves (FlowOptions::put_back_slides, flow/passes/twicing.h).
  bool quantities_are_suspended() const { return conserved_.is_suspended(); }

  /// Ends the suspension. Returns the move (one row per unknown) from the state that restores the
  /// volume and area of the start in first order. Precondition: Jacobian::refactor was called.
  Points resume_quantities();

  /// How a move ended.
  enum class Landing : std::uint8_t {
    complete,
    bounded,     ///< a vertex was stopped by the bound on moves
    infeasible,  ///< the volume or area constraint cannot be met there
  };

  /// Y = the state moved by `move` (one row per unknown), with no vertex further from the start
  /// than `options.max_move`, and with the volume and area corrected if they are kept. Fixed
  /// vertices keep their coordinates in every bit.
  Landing displace(const Points& move, Points& Y) const;

  /// The unknowns that are at the bound on moves and that the negative gradient would move beyond
  /// it.
  std::vector<Index> stopped() const;

  /// The length of the longest row of a move, over all parts.
  double longest(const Points& move) const;

  /// The number of rows of a move that are not zero, over all parts.
  std::int64_t moved(const Points& move) const;

  /// The sum of a count over all parts.
  std::int64_t count(std::int64_t here) const;

  /// The rate of the flow, sqrt(<g, D^-1 g>).
  double gradient_norm();

  /// The mean energy per unknown vertex that the flow removes in a unit of time: |D| s^2 /
  /// #unknowns with |D| the sum over D without damping, and s the power mean with exponent 1/2 of
  /// the speeds |D^-1 g|. With this exponent noise, which is everywhere, counts, and a few needles,
  /// fast as they are, count little.
  double power();

  Jacobian& jacobian() { return *jacobian_; }
  const Jacobian& jacobian() const { return *jacobian_; }

 private:
  double evaluate(const Points& Y, Points& gradient);

  const Points& start_;
  MoveBound bound_;
  ConservedQuantities conserved_;
  FreeRims rims_;  // empty if the flow is not guarded
  std::unique_ptr<BendingEnergy> bending_;
  std::unique_ptr<Jacobian> jacobian_;
  double energy_ = 0, next_energy_ = 0;
  Points G_;  // #V x 3, reused
  Points g_, next_g_;
  Points scratch_;                  // one row per unknown: forces or speeds, reused
  Points by_vertex_, with_others_;  // reused
  bool gradient_is_known_ = false;
};

}  // namespace ibmfair
