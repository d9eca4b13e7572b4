// What a flow of a closed surface can keep exactly: rows that border the Jacobian.
//
// A step d of J d = -h g is replaced by the one that solves the same system with A^T d = 0, where
// the columns of A are the gradients of the quantities: d - J^-1 A (A^T J^-1 A)^-1 A^T d, one more
// solve with the same factor for each. What its length changes in second order is taken back along
// D^-1 A, the fastest way in the metric of the flow.
#pragma once

#include <functional>
#include <vector>

#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

class ConservedQuantities {
 public:
  /// Those that the options name, with their values at `X` as targets; what is referred to outlives
  /// them. Throws BadMesh where some are named and the mesh is not closed or has only one side.
  ConservedQuantities(const Points& X, const Topology& topology, const Unknowns& unknowns,
                      const FlowOptions& options);

  bool empty() const { return kept_.empty(); }

  /// Takes the gradients at the state X, from which steps start.
  void linearise(const Points& X);

  /// Y = J^-1 B, one row per unknown.
  using Solve = std::function<void(const Points& B, Points& Y)>;

  /// Makes the step one that keeps the quantities in first order. With D in place of J, the speed
  /// D^-1 g becomes that of the constrained flow.
  void constrain(Points& step, const Solve& solve) const;

  /// Moves the unknowns of `Y` along D^-1 A until all quantities have their targets to rounding;
  /// false where that fails.
  bool restore(Points& Y, const Eigen::VectorXd& D) const;

  struct Quantity;  ///< a row of the table

 private:
  struct Kept {
    const Quantity* quantity;
    double target;
  };

  const Topology& topology_;
  const Unknowns& unknowns_;
  std::vector<Kept> kept_;
  std::vector<Points> A_;  // the gradient of each at the state, one row per unknown
};

}  // namespace ibmfair
