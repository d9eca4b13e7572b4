// Whether a noisy mesh has creases, and how sharp they are: what is left with hinges held that turn
// by more than some angle, against what is left where all may bend (flow/cutoff_trials.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ibmfair/flow/cutoff_choice.h"

namespace ibmfair {

/// Which hinges are to hold, and the cut-off that goes with it.
struct CreaseChoice {
  double sharp_angle = 0;  ///< FlowOptions::sharp_angle, radians
  CutoffChoice cutoff;
};

/// Whether flows that keep creases, as `options` say but for the angle, leave clearly less risk
/// than the choice that was made `without` them. Where some is to be gained, smaller angles are
/// tried as long as they leave less yet. Throws as choose_cutoff.
std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& held,
                                           const FlowOptions& options, const CutoffChoice& without,
                                           const CutoffSearch& search);

}  // namespace ibmfair
