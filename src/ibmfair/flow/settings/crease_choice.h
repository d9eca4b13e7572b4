// Decides whether a noisy mesh has creases, and how sharp they are. Flows that keep hinges (edges
// with their two triangles) sharper than some angle are compared with a flow in which all hinges
// bend, by the estimated error (risk) that each leaves (flow/settings/added_noise.h): of distances
// and of slopes, because flows that round creases, or make creases of noise, hardly change the
// distance, but tilt the faces.
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

/// Compares flows that keep creases, with `keeping` except for the angle, with `without`, the
/// choice for flows without creases. Returns the choice with the least risk if it is clearly below
/// the risk of that choice; otherwise nothing. Beginning with one angle, smaller ones are tried as
/// long as they do not raise the risk, or larger ones as long as they reduce it. Throws the
/// exceptions of choose_cutoff.
std::optional<CreaseChoice> choose_creases(const Points& X, const Topology& topology,
                                           const std::vector<std::uint8_t>& fixed,
                                           const FlowOptions& keeping, const CutoffChoice& without,
                                           const CutoffSearch& search);

/// Whether what looks like a mixture of independent and correlated noise
/// (CutoffChoice::mixed_noise) is of creases. If the noise is independent, flows that keep creases
/// hardly leave more with a long cut-off than with a short one; otherwise they seem to leave
/// clearly more. The arguments are those of choose_creases.
bool creases_explain_bands(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& keeping,
                           const CutoffChoice& without, const CutoffSearch& search);

}  // namespace ibmfair
