// The loops of energy/lagrange.cpp over the triangles of one block, several at a time.
#pragma once

#include <cstdint>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Adds to the sums of the vertices what `groups` groups of triangles give: the integrated
/// curvature vector h_v, the gradient of the area, and as fourth number the area around v. If
/// `spontaneous`, the fourth number of x_v is the spontaneous curvature H0_v, and h_v is less H0_v
/// times the gradient of the volume.
void lagrange_curvature(const Index* corners, std::int64_t groups, bool spontaneous,
                        BlockVertex* vertices);

/// Adds the gradient of the energy to the sums of the vertices, whose y is y_v = h_v / m_v with
/// |y_v|^2 / 6 as fourth number, or 0 where masses are left out.
void lagrange_forces(const Index* corners, std::int64_t groups, bool spontaneous,
                     BlockVertex* vertices);

}  // namespace ibmfair
