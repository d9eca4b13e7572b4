// Finds foldovers that the flow cannot undo. A folded patch (a few triangles that noise has turned
// over) has less curvature energy than the states on the way to unfolding it, and tangential
// relaxation alone does not unfold it either.
#pragma once

#include "ibmfair/flow/passes/patch_flow.h"

namespace ibmfair {

/// Finds folded patches at the problem's state: patches of the vertices of hinges (edges with their
/// two triangles) that are folded over (CleanUpTuning::fold) although the surface around is nearly
/// flat, and of their neighbours. Sharp edges, the rims of thin sheets and thin tips are not folded
/// patches, because the surface around them is not flat. Foldovers at a boundary or across parts of
/// the mesh are left out. `flat`: the least length of the sum of the surrounding triangles' area
/// vectors, relative to the sum of their lengths (1 for a plane). `rings`: the result of
/// vertex_rings.
std::vector<VertexPatch> find_folded_patches(const FlowProblem& problem,
                                             const CompressedRows& rings, double flat);

/// Whether the triangles around a patch that touch none of its vertices are flat (`flat` as above).
bool is_flat_around(const VertexPatch& patch, const Points& X, const Topology& topology,
                    const CompressedRows& rings, double flat);

/// Moves each vertex of a patch to the mean of its neighbours by repeated sweeps. The limit is
/// foldover-free if the rim of the patch is convex (Tutte 1963).
void even_out(const VertexPatch& patch, const CompressedRows& rings, Points& X);

}  // namespace ibmfair
