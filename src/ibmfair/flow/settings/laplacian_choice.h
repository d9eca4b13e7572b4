// Decides, from the noisy mesh alone, whether another Laplacian than the one for which a cut-off
// was chosen leaves less noise. The umbrella Laplacian, for which the cut-off is chosen first,
// copes with triangles of all shapes, but pulls their corners together: on round shapes of uneven
// triangles it leaves up to twice the error of the linear elements of [W07].
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ibmfair/flow/settings/cutoff_choice.h"

namespace ibmfair {

/// The best cut-off of a flow with the options `other`, if it is expected to leave less than
/// `choice`, that of a flow with the options `first`, and the difference is no chance: the risks of
/// both are estimated with the same added noise (flow/settings/added_noise.h). Precondition: the
/// noise of `choice` is independent. Throws as choose_cutoff does.
std::optional<CutoffChoice> choose_laplacian(const Points& X, const Topology& topology,
                                             const std::vector<std::uint8_t>& fixed,
                                             const FlowOptions& first, const FlowOptions& other,
                                             const CutoffChoice& choice,
                                             const CutoffSearch& search);

}  // namespace ibmfair
