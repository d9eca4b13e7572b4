// Directions in the material along which a surface bends more or less easily: [W07] (14).
#pragma once

#include <vector>

#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A direction in a triangle whose corners are in the order of Topology::F. The energy density is
/// 1/2 (c kappa_1 + kappa_2)^2, where kappa_1 is the curvature along the direction and kappa_2 the
/// curvature across it. The direction is part of the material and deforms with the triangle, but
/// the direction across is perpendicular to it in every state. With c = 1 the energy is therefore
/// isotropic however the triangle deforms. Under isometry, the direction across is fixed in the
/// material, too.
struct MaterialDirection {
  /// The derivatives of the corners' linear basis functions along the direction in the reference
  /// state, 1/length. They sum to 0, and sum_i rate_i x_i is the unit direction mapped to the
  /// positions x.
  ByCorner<double> rate{};
  double factor = 1;  ///< c, dimensionless; positive
};

/// For each triangle (#F), the vector `direction` (any length but 0) projected onto the triangle at
/// the positions X (#V x 3), with `factor` (positive). If the direction makes an angle a with the
/// triangle's plane, the factor is 1 + (factor - 1) cos(a)^2; it tends to 1 when the direction
/// becomes normal to the triangle and its projection vanishes. Throws BadOption for a direction of
/// length 0 and for a factor that is not positive.
std::vector<MaterialDirection> material_directions(const Points& X, const Topology& topology,
                                                   const Vec3& direction, double factor);

}  // namespace ibmfair
