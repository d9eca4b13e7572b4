// The Laplacian and the mass matrix of a member of the family, assembled to compute spectra and to
// check axioms: [W07] sections 2.1 and 2.2.
#pragma once

#include <vector>

#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/energy/vertex_laplacians.h"

namespace ibmfair {

/// Assembled over all usable triangles. Boundary nodes are included without boundary conditions,
/// which amounts to Neumann conditions (no flow across the boundary). E_b uses the rows of L and
/// the block of M that belong to inner nodes.
struct LaplacianMatrices {
  bool edge_based = false;   ///< true: the nodes are edges, rows of Topology::E; false: vertices
  std::vector<Index> nodes;  ///< n; the nodes of usable triangles, in increasing order
  SymmetricMatrix L;  ///< n x n, dimensionless, constants in its kernel; positive semi-definite if
                      ///< the Laplacian's docstring says so (energy/vertex_laplacians.h)
  SymmetricMatrix M;  ///< n x n, length^2, positive definite
};

/// L_ij = -2 cot of the angle between the edges i and j of a triangle, M_ii = a third of the area
/// of the triangles at edge i: Crouzeix-Raviart elements, [W07] section 2.2.
LaplacianMatrices edge_matrices(const Points& X, const Topology& topology, const MassMatrix& mass);

/// The matrices of a vertex-based Laplacian. Obtuse triangles remain at the boundary of an
/// intrinsic Delaunay triangulation, so Voronoi cells can have negative area there: boundary
/// vertices have the mixed Voronoi mass instead.
LaplacianMatrices vertex_matrices(const Points& X, const Topology& topology,
                                  const EnergyOptions& options, const VertexLaplacian& laplacian,
                                  const MassMatrix& mass);

/// The connected components of the graph of L: a component number 0, 1, ... for every node. The
/// kernel of L is spanned by the indicator vectors of the components.
std::vector<Index> joined_parts(const LaplacianMatrices& matrices);

}  // namespace ibmfair
