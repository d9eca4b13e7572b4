// Merges vertices with the same position, or with positions that are close to each other.
#pragma once

#include <vector>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// The result of welding: old vertex v becomes new vertex `vertex[v]`, and new vertex w is old
/// vertex `first[w]`.
struct Weld {
  std::vector<Index> vertex;  ///< #V before welding
  std::vector<Index> first;   ///< #V after welding
};

/// Finds vertices with equal positions (+0 equals -0; nothing is rounded). New vertices are
/// numbered in the order in which their positions first occur. Expected time linear in #V.
Weld find_coincident_vertices(const Points& X);

/// Finds vertices that are close to each other: two vertices are merged if a chain of vertices
/// joins them whose steps have a length of at most `tolerance` (> 0, length). Which vertices are
/// merged does not depend on their order. A new vertex has the position of the first of the
/// vertices that were merged, so that no position changes. New vertices are numbered in the order
/// in which the first of their vertices occur. Expected time linear in #V, unless many vertices lie
/// within a ball of this radius without being joined.
Weld find_close_vertices(const Points& X, double tolerance);

/// The result of one welding after another: `then` numbers the new vertices of `first`.
Weld combined(const Weld& first, const Weld& then);

/// Replaces positions and corners. The faces keep their number and order; some may have a repeated
/// corner afterwards.
void apply(const Weld& weld, Mesh& mesh);

/// What is left of the faces of a mesh.
struct KeptFaces {
  std::vector<Index> face;           ///< numbers of the faces that are left, in order
  std::vector<std::int64_t> corner;  ///< numbers of the corners that are left, in order
};

/// Takes corners out that repeat the corner before them, and then faces with fewer than three
/// corners.
KeptFaces remove_collapsed(Polygons& faces);

}  // namespace ibmfair
