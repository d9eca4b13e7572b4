// Copies rows between the mesh's arrays and the vertices of a block. The loops for both directions
// together take about a tenth of a gradient evaluation.
#pragma once

#include <span>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Loads x from rows v of X (#V x 3), sets its fourth number to 0, and sets the sums to 0.
void load_rows(std::span<const Index> v, const Points& X, BlockVertex* to);

/// Stores the sums to rows v of G (#V x 3).
void store_sums(std::span<const Index> v, const BlockVertex* from, Points& G);

}  // namespace ibmfair
