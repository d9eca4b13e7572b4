// The vertex-based members of the family, for any Laplacian and any mass matrix that are sums over
// triangles: [W07] section 2.2 and Theorem 1.
//
//   h = L X,    E_b = 1/2 tr(h_U^T M_UU^-1 h_U),          U: vertices with a complete one-ring
//
// The gradient is exact. With y = M_UU^-1 h_U, dE = sum_U <y, dh> - 1/2 <y, dM y>, where L and M
// depend on the squared lengths of the edges.
#pragma once

#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/vertex_triangles.h"

namespace ibmfair {

/// The Hessian from `linearise` is the Hessian under isometry, L^T M^-1 L, except for two members
/// for which it has no fixed sparse stencils. For these it is that of a similar member:
///
/// - Intrinsic Delaunay: the cotangent Laplacian of the mesh's own triangles with their mixed
///   Voronoi mass is used. It agrees with the exact one on a Delaunay mesh; on other meshes its
///   Dirichlet energy is larger (S. Rippa, "Minimal roughness property of the Delaunay
///   triangulation", 1990).
/// - Consistent mass, whose inverse is dense: its diagonal is used instead, which is half the
///   lumped mass. M^-1 lies between half and twice the inverse of this diagonal.
class VertexEnergy final : public BendingEnergy {
 public:
  VertexEnergy(const Topology& topology, const EnergyOptions& options,
               const VertexLaplacian& laplacian, const MassMatrix& mass);

  double energy(const Points& X) override;
  double energy_and_gradient(const Points& X, Points& G) override;
  const CompressedRows& stencils() const override { return stencils_; }
  /// 1/2 <h_v, y_v> at every vertex of U.
  PerVertex energy_by_vertex(const Points& X) override;
  void linearise(const Points& X, StencilWeights& weights) override;

 private:
  TriangleTerms by_terms(Index t, const Points& X) const;

  MassMatrix::Kind mass_;
  CompressedRows stencils_;                 // #U rows: the vertex, then its ring in cyclic order
  std::vector<Index> nodes_;                // U
  std::vector<std::uint8_t> own_vertices_;  // EnergyOptions
  VertexTriangles triangles_;
  Points h_, y_;  // #V x 3, zero outside U
  PerVertex m_;   // #V, lumped
  std::vector<TriangleSlopes> slopes_;
};

}  // namespace ibmfair
