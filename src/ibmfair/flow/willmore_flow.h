// Discrete Willmore flow by semi-implicit, inexact Newton steps: [W07] section 3.2.
//
//   dX/dt = -D^-1 grad E_b(X),    G(X) = D (X - X_k) + h grad E_b(X) = 0    (backward Euler)
//
// with the exact nonlinear gradient and the constant Jacobian J = D + h S(X_ref), factored once.
// D is the lumped vertex mass or the identity. One Newton iteration per step by default:
// J d = -h grad E_b(X_k); J is positive definite, so d always points downhill.
//
// The guarded flow reads each step as a Gauss-Newton step and compares the decrease of the energy
// with the predicted one: a step is shortened, the Jacobian renewed or the time step cut where the
// mesh asks for it, and noise is given a few short steps first, where creases are kept a stage of
// its own (flow/first_stage.h). On clean input none of this happens.
// It promises: the energy never rises, no coordinate becomes infinite or NaN, and no hinge folds
// over that was not folded before.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Lets `X` (#V x 3) flow for `options.total_time`, all but the vertices with `held[v]` (#V); those
/// keep their bits. Throws BadOption, FactorizationFailed, OutOfMemory; BadMesh where a coordinate
/// or the energy at the start is not finite.
///
/// Where the mesh is in several `parts`, X, topology and held are those of a piece; the report is
/// that of the whole mesh. Volume and area are kept of a mesh in one piece only: BadOption.
FlowReport willmore_flow(Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
                         const FlowOptions& options, const StepObserver& observer = {},
                         const MeshParts& parts = MeshParts::one());

/// What such a flow would take.
struct FlowForecast {
  std::int64_t unknowns = 0;
  std::string solver;                     ///< the backend that would be used
  std::vector<BackendForecast> backends;  ///< all there are; empty without unknowns
};

/// Throws what the flow would throw before its first step.
FlowForecast forecast_flow(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options);

}  // namespace ibmfair
