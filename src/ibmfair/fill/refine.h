// Refines the triangulation of a patch to a wanted edge length.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

struct RefineOptions {
  double coarsening = 1;    ///< factor of the wanted edge length, away from the rim
  bool curved = false;      ///< new vertices follow the curvature of the surface, not the chords
  Index most_vertices = 0;  ///< the most vertices that the patch may have of its own
};

/// Splits edges that are too long (the longest first, at their middle) and edges that the mesh has
/// already, flips edges to Delaunay and relaxes the new vertices, until the number of too long
/// edges is at most a hundredth of the number of the patch's own vertices. Between the rim and the
/// interior, the edge length grows by at most half of the distance from the rim. Returns false if
/// `most_vertices` ended the refinement.
bool refine(Patch& patch, const RefineOptions& options);

/// The number of edges of the patch that the first pass of `refine`, without coarsening, would
/// split because of their length.
Index count_long_edges(const Patch& patch);

/// Splits only the edges that the mesh has already.
void split_taken_edges(Patch& patch);

/// Moves every free vertex, from number `first` on, half way to the mean of its neighbours,
/// projected off its normal.
void relax(Patch& patch, Index first);

/// Relaxes the patch's own vertices and flips edges to Delaunay, `sweeps` times in turn.
void even_out(Patch& patch, int sweeps);

}  // namespace ibmfair
