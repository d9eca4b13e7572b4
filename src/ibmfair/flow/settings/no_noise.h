// Tells meshes without noise from noisy ones.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Whether the mesh has no noise, or not more than the details of a shape leave in the estimate. So
/// it is if noise that is independent is below NoiseTuning::negligible (or ::negligible_white, if
/// it looks white), or if many hinges are flat: noise bends all hinges by about as much as it is
/// strong, unless it is made of outliers, only in some places, or hidden by rounded coordinates.
/// What looked like independent noise is then that of the edges of a coarse part.
/// `fixed`: #V flags of the vertices that were fixed for the choice, and are not looked at.
bool is_without_noise(const Points& X, const Topology& topology,
                      const std::vector<std::uint8_t>& fixed, const CutoffChoice& choice);

}  // namespace ibmfair
