// Merging vertices that lie at exactly the same place.
#pragma once

#include <vector>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// What welding did: old vertex v is new vertex `vertex[v]`, which is old vertex
/// `first[vertex[v]]`.
struct Weld {
  std::vector<Index> vertex;  ///< #V before
  std::vector<Index> first;   ///< #V after
};

/// Finds equal positions (+0 and -0 are equal, nothing else is rounded). New vertices are numbered
/// in the order in which they are first met. Expected time linear in #V.
Weld find_coincident_vertices(const Points& X);

/// Replaces positions and corners; faces keep their number and order, some may repeat a corner now.
void apply(const Weld& weld, Mesh& mesh);

}  // namespace ibmfair
