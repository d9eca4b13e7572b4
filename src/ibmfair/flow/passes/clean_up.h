// Repairs at the end of a guarded flow, patch by patch: regions that had to be slowed down are
// flowed on, and folded patches (small groups of triangles that noise has folded over for good) are
// unfolded.
#pragma once

#include "ibmfair/flow/passes/patch_flow.h"

namespace ibmfair {

/// Makes both repairs at the state of a flow whose steps have ended, and adds them to the report.
/// The promises of the guarded flow hold: the energy does not rise, and no hinge folds over. Where
/// creases are kept, a sharp fold may be a crease, and nothing is unfolded. `rings`: the result of
/// vertex_rings; `missed`: that of run_guarded.
void clean_up(FlowProblem& problem, const CompressedRows& rings, const FoldWatch& folds,
              const Eigen::VectorXd& missed);

// The following functions only compute moves.

/// Lets the unknowns that lag behind by more than a small share of the flow's time flow on,
/// together with some vertices around them. `deficit`: the time that each unknown has missed, one
/// entry per unknown. Writes the moves to `move` (one row per unknown, length; zero elsewhere).
/// Returns false if no vertex moves in any part of the mesh.
bool catch_up_moves(const FlowProblem& problem, const CompressedRows& rings,
                    const Eigen::VectorXd& deficit, Points& move);

/// Computes moves that unfold folded patches: patches whose hinges are folded over although the
/// surrounding surface is nearly flat. Each patch is evened out first (flow/passes/unfolding.h) and
/// then flows for the whole time; its move is kept if that lowers the energy. Returns false if no
/// vertex moves.
bool unfolding_moves(FlowProblem& problem, const CompressedRows& rings, Points& move);

/// Evens out and flows the given patches, as `unfolding_moves` does with folded patches.
bool even_out_and_flow(const FlowProblem& problem, const CompressedRows& rings,
                       const std::vector<VertexPatch>& patches, Points& move);

}  // namespace ibmfair
