// What a flow of a closed surface can keep exactly: rows that border the Jacobian.
//
// A step d of J d = -h g is replaced by the one that solves the same system with A^T d = 0, where
// the columns of A are the gradients of the quantities: d - J^-1 A (A^T J^-1 A)^-1 A^T d, one more
// solve with the same factor for each. What its length changes in second order is taken back along
// J^-1 A, which is smooth where A, as the normals of a noisy mesh, is not.
#pragma once

#include <functional>
#include <vector>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

class ConservedQuantities {
 public:
  /// Those that the options name, with their values at `X` as targets; what is referred to outlives
  /// them. Throws BadMesh where some are named and the mesh is not closed or has only one side.
  ConservedQuantities(const Points& X, const Topology& topology, const Unknowns& unknowns,
                      const FlowOptions& options);

  /// Whether there is nothing to keep, or not now.
  bool empty() const { return kept_.empty() || suspended_; }

  /// Keeps nothing until `resume`.
  void suspend();
  bool is_suspended() const { return suspended_; }

  /// Y = J^-1 B, one row per unknown.
  using Solve = std::function<void(const Points& B, Points& Y)>;

  /// Takes A and J^-1 A at the state X, from which steps start. Before the first one, J is the
  /// identity.
  void linearise(const Points& X, const Solve& solve);

  /// Keeps the targets again. Returns the move from the state X along J^-1 A, one row per unknown,
  /// that leads there in first order.
  Points resume(const Points& X, const Solve& solve);

  /// Makes the step one that keeps the quantities in first order.
  void constrain(Points& step) const;

  /// The speed D^-1 g less what would change the quantities.
  void speed(const Points& g, const Eigen::VectorXd& D, Points& speed) const;

  /// After `move` (one row per unknown) to `Y`: moves the unknowns along J^-1 A until all
  /// quantities have their targets to rounding; false where that fails. Those whose move is zero
  /// stay, as they may have been withheld from folding.
  bool restore(const Points& move, Points& Y) const;

  struct Quantity;  ///< a row of the table

 private:
  struct Kept {
    const Quantity* quantity;
    double target;
    double rounding;  ///< what may be missing to it
  };

  Eigen::VectorXd missing_at(const Points& Y) const;
  bool is_rounding(const Eigen::VectorXd& missing) const;

  const Topology& topology_;
  const Unknowns& unknowns_;
  std::vector<Kept> kept_;
  bool suspended_ = false;
  std::vector<Points> A_, Z_;  // the gradient of each at the state, one row per unknown, and J^-1 A
};

}  // namespace ibmfair
