// Converts the cut-off wavelength, a length, to the time for which the flow runs.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The flow time after which a ripple of wavelength `cutoff` on a flat sheet has shrunk to 1/e:
/// (cutoff / 2 pi)^4, of unit length^4. A ripple obeys du/dt = -Laplacian^2 u.
double time_for_cutoff(double cutoff);

/// Converts `time` (length^4, as above) to the time unit of the flow that `options` describe. The
/// identity metric lacks the mass of a vertex, and an energy without mass matrix lacks the mass of
/// a stencil; the mean masses over the mesh make up for both. On evenly sampled meshes all variants
/// then smooth alike.
double time_in_flow_units(double time, const Points& X, const Topology& topology,
                          const FlowOptions& options, const MeshParts& parts = MeshParts::one());

}  // namespace ibmfair
