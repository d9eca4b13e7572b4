// Directions in the material, along which a surface bends more or less easily: [W07] (14).
#pragma once

#include <vector>

#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A direction in a triangle, its corners in the order of Topology::F: the density of the energy is
/// 1/2 (c kappa_1 + kappa_2)^2, with the curvatures along it and across it. The direction is part
/// of the material: when the triangle deforms, so does it. What is across it is perpendicular at
/// any time, so that with c = 1 the energy is the isotropic one however the triangle deforms; under
/// isometry that direction is one in the material, too.
struct MaterialDirection {
  /// How fast the linear basis functions of the corners grow along it in the reference, 1/length;
  /// they sum to 0, and sum_i rate_i x_i is the unit direction carried to the positions x.
  ByCorner<double> rate{};
  double factor = 1;  ///< c, dimensionless; positive
};

/// For each triangle (#F) that of `direction` (any length but 0), laid onto the triangle at the
/// positions X (#V x 3), with `factor` (positive). Where it leaves the surface at an angle a, the
/// factor is 1 + (factor - 1) cos(a)^2, so that it tends to 1 where the direction is normal and has
/// no part in the surface. Throws BadOption for a direction of no length and factors that are not
/// positive.
std::vector<MaterialDirection> material_directions(const Points& X, const Topology& topology,
                                                   const Vec3& direction, double factor);

}  // namespace ibmfair
