// The Laplacian and the mass of a member of the family as matrices, for spectra and axioms:
// [W07] sections 2.1 and 2.2.
#pragma once

#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/energy/vertex_laplacians.h"

namespace ibmfair {

/// Over all usable triangles, boundary nodes included, without conditions on the boundary (that is
/// Neumann's: no flow across it). E_b sums over inner nodes: their rows of L, their block of M.
struct LaplacianMatrices {
  bool edge_based = false;   ///< nodes are edges, rows of Topology::E; else vertices
  std::vector<Index> nodes;  ///< n, those of usable triangles, in increasing order
  SymmetricMatrix L;  ///< n x n, dimensionless, constants in its kernel; positive semi-definite
                      ///< where its docstring says so (energy/vertex_laplacians.h)
  SymmetricMatrix M;  ///< n x n, length^2, positive definite
};

/// L_ij = -2 cot of the angle between two edges of a triangle, M_ii = a third of the area around:
/// Crouzeix-Raviart elements, [W07] section 2.2.
LaplacianMatrices edge_matrices(const Points& X, const Topology& topology, const MassMatrix& mass);

/// Of a vertex-based Laplacian. At boundary vertices of an intrinsic Delaunay triangulation, where
/// obtuse triangles stay, cells can be negative: they have the mixed Voronoi mass there.
LaplacianMatrices vertex_matrices(const Points& X, const Topology& topology,
                                  const EnergyOptions& options, const VertexLaplacian& laplacian,
                                  const MassMatrix& mass);

/// The parts in which L joins the nodes: its kernel has this dimension, and is spanned by their
/// indicators. For every node the part, 0 ..
std::vector<Index> joined_parts(const LaplacianMatrices& matrices);

}  // namespace ibmfair
