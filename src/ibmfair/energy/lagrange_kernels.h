// The loops of energy/lagrange.cpp over the fans and the vertices of one block, several at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Adds to the sums of the vertices what the fans give: the integrated curvature vector h_v, the
/// gradient of the area, and as fourth number the area around v. If `spontaneous`, the fourth
/// number of x_v is the spontaneous curvature H0_v, and h_v is less H0_v times the gradient of the
/// volume. Keeps what the forces need in `frames`, one for each vertex of a rim in the groups up to
/// there, or where `keep` is not set uses the first longest_fan + 1 of them.
void lagrange_curvature(const BlockPass& pass, bool spontaneous, bool keep, BlockVertex* vertices,
                        FanFrame* frames);

/// Of a block's vertices, its own and then its rim, -1 or 0 each, which are masks; a multiple of
/// fans_per_group, with zeros for what is behind them.
struct VertexRoles {
  std::vector<std::int8_t> carries;  ///< whether the vertex is in U
  std::vector<std::int8_t> counts;   ///< whether its energy is this block's
};

/// The energy of those of the first `count` vertices that count, from their sums h_v.
double lagrange_energy(const VertexRoles& roles, Index count, bool mass, BlockVertex* vertices);

/// As `lagrange_energy`, and puts y_v = h_v / m_v, or 0 where v is not in U, in the place of x_v,
/// with |y_v|^2 / 6 as fourth number or 0 where masses are left out; and clears the sums, but if
/// `spontaneous` for the fourth number, which becomes that of x_v.
double lagrange_energy_and_y(const VertexRoles& roles, Index count, bool mass, bool spontaneous,
                             BlockVertex* vertices);

/// Adds the gradient of the energy to the sums of the vertices, which are as this has left them.
void lagrange_forces(const BlockPass& pass, bool spontaneous, BlockVertex* vertices,
                     FanFrame* frames);

}  // namespace ibmfair
