// Quantities that a flow of a closed surface can keep exactly (volume, area): rows that border the
// Jacobian.
//
// A step d of J d = -h g is replaced by the step that solves this system under the constraint
// A^T d = 0; the columns of A are the gradients of the quantities. The constrained step is
// d - J^-1 A (A^T J^-1 A)^-1 A^T d, which needs one more solve with J per quantity. The remaining
// second-order change of the quantities is corrected along J^-1 A, which is smooth even if A, like
// the normals of a noisy mesh, is not.
#pragma once

#include <functional>
#include <vector>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The quantities that the options of a flow name, with their values at its start.
class ConservedQuantities {
 public:
  /// Keeps the quantities that the options name, with their values at `X` as targets. `topology`
  /// and `unknowns` must outlive this object. Throws BadMesh if a quantity is named and the mesh is
  /// not closed or not orientable.
  ConservedQuantities(const Points& X, const Topology& topology, const Unknowns& unknowns,
                      const FlowOptions& options);

  /// Whether no quantity is kept at present: none was named, or all are suspended.
  bool empty() const { return kept_.empty() || suspended_; }

  /// Keeps nothing until `resume`.
  void suspend();
  bool is_suspended() const { return suspended_; }

  /// Y = J^-1 B, one row per unknown.
  using Solve = std::function<void(const Points& B, Points& Y)>;

  /// Computes A and J^-1 A at X, the state from which the next step starts. Until the first call,
  /// J is taken to be the identity.
  void linearise(const Points& X, const Solve& solve);

  /// Ends the suspension. Returns the move from the state X along J^-1 A, one row per unknown, that
  /// brings the quantities back to their targets in first order.
  Points resume(const Points& X, const Solve& solve);

  /// Changes the step so that it keeps the quantities in first order.
  void constrain(Points& step) const;

  /// The speed D^-1 g without the part that would change the quantities.
  void speed(const Points& g, const Eigen::VectorXd& D, Points& speed) const;

  /// To be called after `move` (one row per unknown) has led to `Y`. Moves the unknowns along
  /// J^-1 A until all quantities reach their targets up to rounding; false if that fails. Unknowns
  /// whose move is zero stay, as their move may have been withheld to avoid foldovers.
  bool restore(const Points& move, Points& Y) const;

  struct Quantity;  ///< a row of the table

 private:
  struct Kept {
    const Quantity* quantity;
    double target;
    double rounding;  ///< the accepted difference from the target
  };

  Eigen::VectorXd missing_at(const Points& Y) const;
  bool is_rounding(const Eigen::VectorXd& missing) const;

  const Topology& topology_;
  const Unknowns& unknowns_;
  std::vector<Kept> kept_;
  bool suspended_ = false;
  std::vector<Points> A_, Z_;  // gradients at the state, one row per unknown, and J^-1 A
};

}  // namespace ibmfair
