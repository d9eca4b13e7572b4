// Twicing: the residual of a smoother (the part that it removed) is smoothed as well and added back
// (J. W. Tukey, "Exploratory Data Analysis", 1977).
//
// A flow of time T leaves the share g = exp(-T k^4) of a ripple of wave number k. So it also
// removes a little of every ripple that should stay: spheres shrink, bumps flatten. The residual
// consists of this loss and of the noise. The residual smoothed by the flow linearised at the
// result is an estimate of the loss. After it has been added back n times, the share of the ripple
// is 1 - (1 - g)^(n + 1): flat to the order k^(4 n + 4) at k = 0, and steeper at the cut-off.
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {

/// Applies `options.twicing` passes of twicing to the state of a completed flow. The residual is
/// the height of the start over the surface along the normals, so that no vertex slides back within
/// the surface; with `options.put_back_slides` it is the whole move. If the flow is linear in the
/// coordinates, as that of the umbrella operator is, whole moves make twicing the filter above for
/// each coordinate. That needs volume and area to be restored only at the end
/// (flow/passes/restored_quantities.h), because a flow that keeps them is not linear. The promises
/// of the guarded flow hold: no hinge folds over that was not folded at the end of the flow, the
/// energy stays below that at the start, and bounds on moves, volume and area are kept. If a pass
/// fails, the passes end; the report counts the completed passes. `tolerance`: the relative
/// residual of linear systems.
void apply_twicing(FlowProblem& problem, double tolerance = tuning.twicing.tolerance);

}  // namespace ibmfair
