// The Gauss-Newton model of the energy along a Newton step.
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// For a step d with J d = -h g, J = D + h S, the model predicts that a part a of the step lowers
/// the energy by -a <g,d> - a^2/2 d^T S d = (a - a^2/2) <-g,d> + a^2/2 <d,Dd>/h > 0. For energies
/// that are quadratic in the positions, with S their Hessian, this is exact, except with free rims,
/// where d is cut to its part along the normals (flow/steps/free_rims.h).
class StepModel {
 public:
  StepModel() = default;

  /// `step`: one row per unknown, from the problem's state by its Jacobian.
  StepModel(FlowProblem& problem, const Points& step);

  /// The predicted decrease of the energy for the part `a`. A few bad triangles can make the model
  /// predict more than the whole energy; hence the prediction is at most that.
  double decrease(double a) const;

 private:
  double slope_ = 0;        // <-g,d>
  double metric_part_ = 0;  // <d,Dd>/h
  double energy_ = 0;
};

}  // namespace ibmfair
