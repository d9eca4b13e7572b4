// Decides whether a noisy mesh has creases, and how sharp they are. Flows that keep hinges (edges
// with their two triangles) sharper than some angle are compared with a flow in which all hinges
// bend, by the estimated error (risk) that each leaves (flow/settings/cutoff_trials.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ibmfair/flow/settings/cutoff_choice.h"

namespace ibmfair {

/// The hinges to keep sharp, and the cut-off wavelength that goes with this choice.
struct CreaseChoice {
  double sharp_angle = 0;  ///< FlowOptions::sharp_angle, radians
  CutoffChoice cutoff;
};

/// Tries flows that keep creases, with `options` except for the angle. Returns the choice with the
/// least risk if it is clearly below that of `without`, the choice without creases; otherwise
/// nothing. If the first angle reduces the risk, smaller angles are tried as long as they reduce it
/// further. Throws the exceptions of choose_cutoff.
std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& fixed,
                                           const FlowOptions& options, const CutoffChoice& without,
                                           const CutoffSearch& search);

}  // namespace ibmfair
