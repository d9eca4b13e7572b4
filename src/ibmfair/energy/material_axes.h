// Directions in the material, along which a surface bends more or less easily: [W07] (14).
#pragma once

#include <vector>

#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// One direction in a triangle. It is part of the material: when the triangle deforms, so does it.
struct MaterialDirection {
  /// How fast the linear basis functions of the corners grow along it in the reference, 1/length;
  /// they sum to 0, and sum_i rate_i x_i is the unit direction carried to the positions x.
  ByCorner<double> rate{};
  double factor = 0;  ///< c of [W07] (14), dimensionless; at least 0
};

/// The directions of a triangle, its corners in the order of Topology::F: the density of the energy
/// is 1/2 (c_1 kappa_1 + c_2 kappa_2)^2.
using MaterialAxes = std::array<MaterialDirection, 2>;

/// For each triangle (#F) two perpendicular directions: that of `direction` (any length but 0),
/// laid onto the triangle at the positions X (#V x 3), with `factor` (positive), and that across it
/// with factor 1. Where the direction leaves the surface at an angle a, the factor is 1 + (factor -
/// 1) cos(a)^2, so that it tends to 1 where the direction is normal and has no part in the surface.
/// Throws BadOption for a direction of no length and factors that are not positive.
std::vector<MaterialAxes> material_axes(const Points& X, const Topology& topology,
                                        const Vec3& direction, double factor);

}  // namespace ibmfair
