// What moves vertices besides the flow itself, at cut-offs so short that the flow hardly moves any:
// the shorter the cut-off, the less of it.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The options with less tangential relaxation, none of it across creases (which such a cut-off is
/// too short to smooth), and without a clean-up if the cut-off is shorter
/// than an edge; nothing if the cut-off that `options.total_time` corresponds to is long enough for
/// all of it. As the cut-off goes to 0, all moves go to 0: relaxation as the square of the cut-off,
/// the flow as its fourth power.
std::optional<FlowOptions> short_cutoff_options(const Points& X, const Topology& topology,
                                                const FlowOptions& options, const MeshParts& parts);

}  // namespace ibmfair
