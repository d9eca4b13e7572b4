// The loops of energy/crouzeix_raviart.cpp over the triangles of one block, several at a time.
#pragma once

#include <cstdint>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// The unit normal and the area of every triangle in `groups` groups, at least one.
void crouzeix_raviart_frames(const Index* corners, std::int64_t groups, const BlockVertex* vertices,
                             BlockRow* triangles);

/// What a hinge adds to the energy.
struct HingeTerms {
  bool mass = true;
  double inverse_bound = 0;  ///< of the energy of a hinge; 0: none
};

struct HingeSums {
  double energy = 0;        ///< of the first `own_groups`, half of a hinge's from either side
  double largest_turn = 0;  ///< 1 + cos(theta), of all `groups`
};

/// The sums over the hinges of a block. Adds the gradient of the energy from all `groups` to the
/// sums of the vertices, if `gradient`.
HingeSums crouzeix_raviart_hinges(const MeshBlock& block, const Index* corners,
                                  const Index* neighbours, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const BlockRow* triangles);

}  // namespace ibmfair
