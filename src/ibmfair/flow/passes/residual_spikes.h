// Residual spikes: after a flow that keeps creases, a few hinges (edges with their two triangles)
// still turn sharply where the noise was strongest, because the flow took them for creases.
#pragma once

#include "ibmfair/flow/passes/patch_flow.h"

namespace ibmfair {

/// The patches of vertices that are residual spikes at the problem's state rather than creases,
/// which are long lines. The hinges at a residual spike turn by more than half of the sharp angle
/// of the options, so that the flow keeps them sharp at least in part; they are few, they branch or
/// form a closed loop, and the surface around them is nearly flat. `rings`: the result of
/// vertex_rings.
std::vector<VertexPatch> find_residual_spikes(const FlowProblem& problem,
                                              const CompressedRows& rings);

/// Evens out the residual spikes at the problem's state, the end of its flow, and lets them flow
/// again together with their neighbours. Only for meshes that were noisy: without noise, a residual
/// spike is a detail of the shape. The promises of the guarded flow hold: the energy does not rise,
/// and no hinge folds over.
void flatten_residual_spikes(FlowProblem& problem, const CompressedRows& rings);

}  // namespace ibmfair
