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

struct CreaseFindings {
  /// Whether the noise is CutoffChoice::mixed_noise, as creases do not explain what looks like it.
  /// Nothing else is chosen then.
  bool noise_is_mixed = false;
  std::optional<CreaseChoice> choice;
};

/// Compares flows that keep creases, with `keeping` except for the angle, with `without`, the
/// choice for flows without creases. Finds the choice with the least risk if it is clearly below
/// the risk of that choice; otherwise nothing. Beginning with one angle, smaller ones are tried as
/// long as they do not raise the risk, or larger ones as long as they reduce it.
///
/// If the noise may be mixed, flows that keep even blunt creases tell: if the noise is independent,
/// they hardly leave more with a long cut-off than with a short one; otherwise they seem to leave
/// clearly more. Throws the exceptions of choose_cutoff.
CreaseFindings choose_creases(const Points& X, const Topology& topology,
                              const std::vector<std::uint8_t>& fixed, const FlowOptions& keeping,
                              const CutoffChoice& without, const CutoffSearch& search);

}  // namespace ibmfair
