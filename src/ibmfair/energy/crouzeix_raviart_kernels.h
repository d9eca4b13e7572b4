// The loops of energy/crouzeix_raviart.cpp over the fans of one block, several fans at a time.
#pragma once

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Half the unit normal and a sixth of the area of every triangle of the fans, stored in the
/// triangle's row (MeshBlock::neighbours). With this scaling, the formulas of the hinges need no
/// further factors.
void crouzeix_raviart_frames(const BlockPass& pass, const BlockVertex* vertices, Row4* triangles);

/// Which terms a hinge adds to the energy.
struct HingeTerms {
  bool mass = true;
  double inverse_bound = 0;  ///< 1 / the bound of a hinge's energy; 0: no bound
};

struct HingeSums {
  double energy = 0;  ///< of the block's `own_groups`; each side of a hinge adds half of its energy
  double max_dihedral_turn = 0;  ///< the largest 1 + cos(theta)
};

/// The sums over the hinges of the fans. If `gradient`, adds the gradient of the hinges' energy to
/// the sums of the vertices.
HingeSums crouzeix_raviart_hinges(const BlockPass& pass, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const Row4* triangles);

}  // namespace ibmfair
