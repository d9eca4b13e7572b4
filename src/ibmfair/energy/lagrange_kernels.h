// The loops of energy/lagrange.cpp over the fans and the vertices of one block, several at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Adds the contributions of the fans to the sums of the vertices: the integrated curvature vector
/// h_v (the gradient of the area) and, as fourth number, the area around v. If `spontaneous`, the
/// fourth number of x_v is the spontaneous curvature H0_v, and H0_v times the gradient of the
/// volume is subtracted from h_v. If `keep` is set, the data that the forces need is kept in
/// `frames`, one frame for each vertex of a rim in the groups of the pass; otherwise only the first
/// longest_fan + 1 frames are used, as scratch memory.
void lagrange_curvature(const BlockPass& pass, bool spontaneous, bool keep, BlockVertex* vertices,
                        FanFrame* frames);

/// Masks (-1 or 0) for a block's vertices, first its own vertices and then those of its rim. The
/// length is a multiple of fans_per_group; the padding is zero.
struct VertexRoles {
  std::vector<std::int8_t> carries;  ///< whether the vertex is in U
  std::vector<std::int8_t> counts;   ///< whether its energy is added in this block
};

/// The energy of the vertices with `counts` set among the first `count` vertices, from their sums
/// h_v.
double lagrange_energy(const VertexRoles& roles, Index count, bool mass, BlockVertex* vertices);

/// Returns the energy as `lagrange_energy` does. Also replaces x_v by y_v = h_v / m_v, or by 0 if v
/// is not in U; the fourth number becomes |y_v|^2 / 6, or 0 if the mass is left out. The sums are
/// then cleared; but if `spontaneous`, the fourth number of a sum becomes the fourth number of x_v.
double lagrange_energy_and_y(const VertexRoles& roles, Index count, bool mass, bool spontaneous,
                             BlockVertex* vertices);

/// Adds the gradient of the energy to the sums of the vertices. Precondition: `vertices` is as
/// lagrange_energy_and_y() leaves it.
void lagrange_forces(const BlockPass& pass, bool spontaneous, BlockVertex* vertices,
                     FanFrame* frames);

}  // namespace ibmfair
