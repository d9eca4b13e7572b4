// What the plain and the guarded flow share: the state, its energy and gradient, and the Newton
// step at a frozen Jacobian.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/conserved_quantities.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/folds.h"
#include "ibmfair/flow/jacobian.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/move_bound.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

class FlowProblem {
 public:
  /// Everything referred to must outlive the problem, and stay as it is. The flow starts at `X`.
  FlowProblem(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
              const FlowOptions& options, const MeshParts& parts);

  const Topology& topology;
  const FlowOptions& options;
  const MeshParts& parts;
  const Unknowns unknowns;
  FlowReport report;
  Points X;  ///< #V x 3, the state

  /// Where the flow started.
  const Points& start() const { return start_; }

  /// E_b over the stencils that touch an unknown, of all parts, at the state and at another place.
  double energy() const { return energy_; }
  double energy_at(const Points& Y);

  /// Whether the last place whose energy was asked for, which was `energy`, has no hinges here with
  /// a smaller dihedral angle than `angle` (radians); where false, there may be some.
  bool has_no_folds(double energy, double angle = fold_angle) const;

  /// The vertices of hinges that have folded over at Y, which is that place (FoldWatch::new_folds).
  std::vector<Index> new_folds(FoldWatch& folds, const Points& Y, double energy) const;

  /// Evaluates the energy and its gradient at the state, where they are not known.
  void update_gradient();

  /// The energy at another place, where the state is likely to be next.
  double try_state(const Points& Y);

  /// Moves the state to Y, and leaves the one before in Y.
  void move_to(Points& Y);

  /// As `move_to`, where Y is the last place that was tried: its energy and gradient are known.
  void move_to_tried(Points& Y);

  /// The gradient at the state (by `update_gradient`), one row per unknown.
  const Points& gradient() const { return g_; }

  /// The gradient at another place, one row per unknown.
  Points gradient_at(const Points& Y);

  /// Both at once, which costs little more than one: returns the energy.
  double energy_and_gradient_at(const Points& Y, Points& gradient);

  /// The step of backward Euler from the state with the Jacobian's own time step, by
  /// `options.newton_iterations` inexact Newton iterations: one row per unknown, length.
  void newton_step(Points& step);

  /// The move (one row per unknown) with rows for the unknowns of other parts behind its own.
  const Points& with_others(const Points& move);

  /// Whether volume and area are to be kept, but not on the way: where twicing puts back slides,
  /// flow/twicing.h.
  bool quantities_are_suspended() const { return conserved_.is_suspended(); }

  /// They are kept from now on. Returns the move (one row per unknown) from the state to where they
  /// are as they were at the start, in first order. After the Jacobian's first `refactor`.
  Points resume_quantities();

  /// How a move ended.
  enum class Landing : std::uint8_t {
    as_asked,
    short_of_it,  ///< a vertex was stopped by the bound on moves
    infeasible,   ///< the volume or area constraint cannot be met there
  };

  /// Y = the state moved by `move` (one row per unknown), no vertex further from the start than
  /// `options.max_move`, with the volume and area to keep. Held vertices keep their bits.
  Landing displace(const Points& move, Points& Y) const;

  /// The unknowns that the bound on moves keeps from going where the gradient sends them.
  std::vector<Index> stopped() const;

  /// The longest row of a move.
  double longest(const Points& move) const;

  /// How many rows of a move are not zero, over all parts.
  std::int64_t moved(const Points& move) const;

  /// The rate of the flow, sqrt(<g, D^-1 g>).
  double gradient_norm();

  /// The energy that the flow takes off a vertex in a unit of time, on the average: |D| s^2 / #V,
  /// |D| the sum over D without damping. Of the speed |D^-1 g| counts the mean s of power 1/2:
  /// noise is everywhere, and a few needles, as fast as they are, have little part in it.
  double power();

  Jacobian& jacobian() { return *jacobian_; }
  const Jacobian& jacobian() const { return *jacobian_; }

 private:
  double evaluate(const Points& Y, Points& gradient);

  const Points& start_;
  MoveBound bound_;
  ConservedQuantities conserved_;
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
