// The consistent mass matrix of linear elements: a triangle of area A adds A / 12 (1 + delta_ij)
// for its corners i and j.
#pragma once

#include <span>

#include "ibmfair/energy/vertex_triangles.h"

namespace ibmfair {

/// Y = M_UU^-1 H for the rows U of H, #V x 3. The other rows of Y must be zero and stay zero.
/// `lumped` (#V) has the row sums of M for the rows U.
///
/// The solver is Chebyshev's iteration. The eigenvalues of lumped^-1 M lie in [1/4, 1] on any mesh
/// (A. Wathen, "Realistic eigenvalue bounds for the Galerkin mass matrix", 1987), so every sweep
/// reduces the error to a third, and a fixed number of sweeps reaches working precision.
void solve_consistent_mass(const VertexTriangles& triangles, std::span<const Index> U,
                           const PerVertex& lumped, const Points& H, Points& Y);

/// The derivative of 1/2 tr(Y^T M Y) with respect to a triangle's area, from Y at the three
/// corners.
double consistent_mass_slope(const Vec3& y0, const Vec3& y1, const Vec3& y2);

}  // namespace ibmfair
