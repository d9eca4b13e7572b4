// Tells meshes without noise from noisy ones.
#pragma once

#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Whether the mesh has no noise, or not more than the details of a shape leave in the estimate. So
/// it is if noise that is independent is below NoiseTuning::negligible (or ::negligible_white, if
/// it looks white), or if many hinges are flat: noise bends all hinges, unless it is made of
/// outliers or only in some places.
bool is_without_noise(const Points& X, const Topology& topology, const CutoffChoice& choice);

}  // namespace ibmfair
