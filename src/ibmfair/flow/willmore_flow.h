// Discrete Willmore flow by semi-implicit, inexact Newton steps: [W07] section 3.2.
//
//   dX/dt = -D^-1 grad E_b(X),    G(X) = D (X - X_k) + h grad E_b(X) = 0    (backward Euler)
//
// with the exact nonlinear gradient and the constant Jacobian J = D + h S(X_ref), factored once.
// D is the lumped vertex mass or the identity. By default each step is one Newton iteration,
// J d = -h grad E_b(X_k); J is positive definite, so d is a descent direction.
//
// The guarded flow reads each step as a Gauss-Newton step and compares the decrease of the energy
// with the predicted decrease. If they disagree, the guard shortens the step, renews the Jacobian
// or cuts the time step. Noisy meshes start with a few short steps, and in a separate first stage
// if creases are kept (flow/first_stage.h). On clean input none of this happens.
// The guarded flow promises: the energy never rises, no coordinate becomes infinite or NaN, and no
// hinge (an edge with its two triangles) folds over that was not folded before.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Lets `X` (#V x 3) flow for `options.total_time`. Vertices with `fixed[v]` set (#V) are fixed:
/// their coordinates do not change in any bit. Throws BadOption, FactorizationFailed, OutOfMemory;
/// BadMesh if a coordinate or the energy at the start is not finite.
///
/// If the mesh is spread over several `parts` (flow/mesh_parts.h), X, topology and fixed belong to
/// one piece, and the report is about the whole mesh. Keeping volume or area then throws BadOption.
FlowReport willmore_flow(Points& X, const Topology& topology,
                         const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                         const StepObserver& observer = {},
                         const MeshParts& parts = MeshParts::one());

/// The predicted cost of a flow.
struct FlowForecast {
  std::int64_t unknowns = 0;              ///< vertices that are not fixed
  std::string solver;                     ///< the backend that the flow would use
  std::vector<BackendForecast> backends;  ///< every backend; empty if there are no unknowns
};

/// Predicts the cost of `willmore_flow` with these arguments. Throws the exceptions that the flow
/// would throw before its first step.
FlowForecast forecast_flow(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options);

}  // namespace ibmfair
