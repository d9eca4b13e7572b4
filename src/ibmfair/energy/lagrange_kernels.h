// The loops of energy/lagrange.cpp over the fans of one block, several fans at a time.
#pragma once

#include <cstdint>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Adds to the sums of the vertices what the fans give: the integrated curvature vector h_v, the
/// gradient of the area, and as fourth number the area around v. If `spontaneous`, the fourth
/// number of x_v is the spontaneous curvature H0_v, and h_v is less H0_v times the gradient of the
/// volume. Keeps what the forces need in `frames`, one for each vertex of a rim in the groups up to
/// there, or where `keep` is not set uses the first longest_fan + 1 of them.
void lagrange_curvature(const FanRange& fans, bool spontaneous, bool keep, BlockVertex* vertices,
                        FanFrame* frames);

/// Adds the gradient of the energy to the sums of the vertices, whose y is y_v = h_v / m_v with
/// |y_v|^2 / 6 as fourth number, or 0 where masses are left out.
void lagrange_forces(const FanRange& fans, bool spontaneous, BlockVertex* vertices,
                     FanFrame* frames);

}  // namespace ibmfair
