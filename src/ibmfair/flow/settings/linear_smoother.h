// Trials of flows that are linear in the positions: the energy with the umbrella Laplacian and a
// mass that counts triangles is a quadratic form of constant coefficients, so that the flow is
// known as a function of its operator (operator_functions.h). The degree of the polynomial grows
// with the square of the cut-off; from some degree on, linear systems with a factorization take
// less time. What the guard of a flow does to single vertices is left out.
#pragma once

#include <vector>

#include "ibmfair/flow/settings/operator_functions.h"
#include "ibmfair/flow/settings/trial_smoother.h"
#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Whether the flow, without its guard, is linear. The sharp angle is not used.
bool is_linear(const FlowOptions& options);

class LinearSmoother final : public TrialSmoother {
 public:
  /// Precondition: `is_linear(mesh.options())`. Throws the exceptions of FlowProblem.
  LinearSmoother(const TrialMesh& mesh, const Unknowns& unknowns);

  Points smooth(double cutoff) override;
  Points taken_of(const Points& noise) override;

 private:
  /// The polynomial for what a flow in so many steps removes, or none if it had too many terms.
  std::vector<double> series_for(int steps) const;
  /// Linearises the flow for so many steps. False if there is too little memory.
  bool linearise(int steps);
  /// What the flow, without twicing, removes from the positions, one row per unknown.
  Points taken_of_mesh();
  /// What a flow in so many steps leaves of `b`, one row per unknown.
  Points kept_of(const Points& b, int steps);

  const TrialMesh& mesh_;
  const Unknowns& unknowns_;
  FlowOptions options_;
  bool can_factor_ = true;  // there is enough memory
  FlowProblem problem_;     // stays at the start
  double largest_rate_;
  JacobianRows J_;
  OperatorFunctions functions_;
};

}  // namespace ibmfair
