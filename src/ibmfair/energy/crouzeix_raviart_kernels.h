// The loops of energy/crouzeix_raviart.cpp over the triangles of one block, four at a time.
#pragma once

#include <cstdint>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// The unit normal and the area of every triangle in `groups` groups.
void crouzeix_raviart_frames(const Index* corners, std::int64_t groups, const BlockVertex* vertices,
                             BlockRow* triangles);

/// What a hinge adds to the energy.
struct HingeTerms {
  bool mass = true;
  double inverse_bound = 0;  ///< of the energy of a hinge; 0: none
};

/// The energy of the hinges of the first `own_groups`, half of it from either side. Adds its
/// gradient from all `groups` to the sums of the vertices, if `gradient`.
double crouzeix_raviart_hinges(const MeshBlock& block, const Index* corners,
                               const Index* neighbours, const HingeTerms& terms, bool gradient,
                               BlockVertex* vertices, const BlockRow* triangles);

}  // namespace ibmfair
