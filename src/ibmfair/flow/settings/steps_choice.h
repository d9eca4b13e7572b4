// Decides how far a mesh of steps (level_steps.h) may be smoothed. The error of a coordinate that
// was rounded, or of a surface of voxels, is hardly larger than a step; a flow that moves vertices
// further removes edges and details of the shape as well. Not to go further away from data than
// their errors explain is the discrepancy principle of V. A. Morozov, "On the solution of
// functional equations by the method of regularization", Soviet Mathematics Doklady 7 (1966).
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct StepsChoice {
  double cutoff = 0;       ///< length
  double sharp_angle = 0;  ///< FlowOptions::sharp_angle; 0 if no creases are kept
};

/// The smoothest flow that steps of the distance `step` (length) explain: to the cut-off `longest`
/// (length) without creases; else to that cut-off with creases; else to the longest of the shorter
/// ones with creases; if none is explained, the shortest one. `options` must be able to keep
/// creases; their sharp angle and total time are not used. Throws the exceptions of the flow.
StepsChoice choose_for_steps(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                             double step, double longest, const CutoffSearch& search);

}  // namespace ibmfair
