// Tells meshes without noise from noisy ones.
#pragma once

#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Whether the mesh has no noise, or not more than the details of a shape leave in the estimate. So
/// it is if the estimated noise is below NoiseTuning::negligible (or ::negligible_white, if the
/// noise looks white), or if many hinges are flat: noise bends all hinges. Noise of other kinds
/// than independent is recognized by other means, and the result is then false.
bool is_without_noise(const Points& X, const Topology& topology, const CutoffChoice& choice);

}  // namespace ibmfair
