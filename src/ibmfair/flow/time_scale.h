// From the length that a user thinks in to the time that the flow runs for.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The flow time after which a ripple of wavelength `cutoff` on a flat sheet has shrunk to 1/e:
/// (cutoff / 2 pi)^4, of unit length^4. A ripple obeys du/dt = -Laplacian^2 u.
double time_for_cutoff(double cutoff);

/// Converts `time` (length^4, as above) to the unit of the flow that `options` describe, by the
/// mean masses of the mesh: the identity metric leaves out the mass of a vertex, an energy without
/// mass matrix that of a stencil. On evenly sampled meshes all variants then smooth alike.
double time_in_flow_units(double time, const Points& X, const Topology& topology,
                          const FlowOptions& options, const MeshParts& parts = MeshParts::one());

}  // namespace ibmfair
