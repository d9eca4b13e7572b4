// The loops of energy/crouzeix_raviart.cpp over the fans of one block, several fans at a time.
#pragma once

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Half the unit normal and a sixth of the area of every triangle of the fans, in its row
/// (MeshBlock::neighbours): so scaled they need no factors in the hinges.
void crouzeix_raviart_frames(const BlockPass& pass, const BlockVertex* vertices, Row4* triangles);

/// What a hinge adds to the energy.
struct HingeTerms {
  bool mass = true;
  double inverse_bound = 0;  ///< of the energy of a hinge; 0: none
};

struct HingeSums {
  double energy = 0;        ///< of the block's `own_groups`, half of a hinge's from either side
  double largest_turn = 0;  ///< 1 + cos(theta)
};

/// The sums over the hinges of the fans. Adds the gradient of their energy to the sums of the
/// vertices, if `gradient`.
HingeSums crouzeix_raviart_hinges(const BlockPass& pass, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const Row4* triangles);

}  // namespace ibmfair
