// The consistent mass of linear elements: A / 12 (1 + delta_ij) for the corners of a triangle.
#pragma once

#include <span>

#include "ibmfair/energy/vertex_triangles.h"

namespace ibmfair {

/// Y = M_UU^-1 H for the rows U of H, #V x 3; other rows of Y are and stay zero. `lumped` has the
/// row sums of M, #V, for the rows U.
///
/// Chebyshev's iteration: the eigenvalues of lumped^-1 M lie in [1/4, 1] on any mesh (A. Wathen,
/// "Realistic eigenvalue bounds for the Galerkin mass matrix", 1987), so the error falls to a third
/// with every sweep, and a fixed number of them reaches working precision.
void solve_consistent_mass(const VertexTriangles& triangles, std::span<const Index> U,
                           const PerVertex& lumped, const Points& H, Points& Y);

/// The derivative of 1/2 tr(Y^T M Y) by a triangle's area, from Y at its corners.
double consistent_mass_slope(const Vec3& y0, const Vec3& y1, const Vec3& y2);

}  // namespace ibmfair
