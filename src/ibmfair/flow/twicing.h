// Twicing: what a smoother took away is smoothed, too, and put back (J. W. Tukey, "Exploratory Data
// Analysis", 1977).
//
// A flow of time T leaves the share g = exp(-T k^4) of a ripple of wave number k, and so takes a
// little off every ripple that it is to keep: a sphere shrinks, a bump flattens. Its residual holds
// that and the noise. Smoothed in its turn, by the linearised flow at the result, it is what the
// flow should not have taken. Put back n times, the share that is left is 1 - (1 - g)^(n + 1): flat
// to the order k^(4 n + 4) at k = 0, and steeper at the cut-off.
#pragma once

#include "ibmfair/flow/flow_problem.h"

namespace ibmfair {

/// Does that `options.twicing` times to the state of a flow that is complete. The residual is taken
/// as a height over the surface, so that no vertex slides back, or with `options.put_back_slides`
/// as a move: where the flow is linear in the coordinates, as the umbrella's is, that makes it the
/// filter above of each of them, if volume and area are not kept on the way but brought back at the
/// end (willmore_flow): a flow that keeps them goes another way. What the guarded flow promises
/// holds: no hinge folds over that was not folded at the flow's end, the energy stays below that at
/// its start, bounds on moves, volume and area are kept. A pass that cannot be done ends them; the
/// report counts those that were.
void twice(FlowProblem& problem);

}  // namespace ibmfair
