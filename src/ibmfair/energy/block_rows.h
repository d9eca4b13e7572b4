// The rows of a mesh's vertices as a block holds them: one loop over both ways is a tenth of a
// gradient.
#pragma once

#include <span>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// x out of rows v of X (#V x 3), with 0 as fourth number, and sums of 0.
void load_rows(std::span<const Index> v, const Points& X, BlockVertex* to);

/// The sums to rows v of G (#V x 3).
void store_sums(std::span<const Index> v, const BlockVertex* from, Points& G);

}  // namespace ibmfair
