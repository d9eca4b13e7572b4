// Refines the triangulation of a patch to a wanted edge length.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

struct RefineOptions {
  double coarsening = 1;    ///< edges this many times as long as wanted, away from the rim
  bool curved = false;      ///< follow the surface's curvature instead of the chords
  Index most_vertices = 0;  ///< that the patch may have of its own
};

/// Splits edges that are too long (the longest first, at their middle) and edges that the mesh has
/// already, flips to Delaunay and evens the new vertices out, until edges that are too long are
/// fewer than a hundredth of the patch's own vertices. The edge length grows from the rim's to the
/// coarse one by at most half of the distance. Returns false where `most_vertices` ended it.
bool refine(Patch& patch, const RefineOptions& options);

/// The number of edges of the patch that `refine` with no coarsening would split at once.
Index count_long_edges(const Patch& patch);

/// Splits only the edges that the mesh has already.
void split_taken_edges(Patch& patch);

/// Every free vertex from `first` on moves half way to the mean of its neighbours, projected off
/// the normal.
void relax(Patch& patch, Index first);

/// `sweeps` times: the patch's own vertices are relaxed, then edges are flipped to Delaunay.
void even_out(Patch& patch, int sweeps);

}  // namespace ibmfair
