// What a flow of the whole mesh leaves behind is brought up to the rest at its end, patch by patch:
// what it had to slow down, and flaps that noise folded over for good. Energy and folds are looked
// after by whoever makes the moves.
#pragma once

#include "ibmfair/flow/patch_flow.h"

namespace ibmfair {

/// Lets those unknowns flow on that lag behind by more than a small share of the flow's time, and
/// some vertices around them. `lag`: one entry per unknown, the time that it has missed. Writes the
/// moves (one row per unknown, length; zero elsewhere); false, and nothing done, where none are
/// made in any part of the mesh.
bool catch_up_moves(const FlowProblem& problem, const Rows& rings, const Eigen::VectorXd& lag,
                    Points& move);

/// Moves for patches whose hinges are folded over though the surface around is not bent much: such
/// a patch is evened out first (flow/unfolding.h), then flows for the whole time, and moves where
/// that leaves less energy than there is now.
bool unfolding_moves(FlowProblem& problem, const Rows& rings, Points& move);

/// As `unfolding_moves`, for any patches.
bool even_out_and_flow(const FlowProblem& problem, const Rows& rings,
                       const std::vector<VertexPatch>& patches, Points& move);

}  // namespace ibmfair
