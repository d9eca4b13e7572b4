// Merges vertices with exactly the same position.
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

/// Replaces positions and corners. The faces keep their number and order; some may have a repeated
/// corner afterwards.
void apply(const Weld& weld, Mesh& mesh);

}  // namespace ibmfair
