// The vertex-based member of the family, with linear Lagrange elements and lumped mass: the
// cotangent Laplacian, [W07] section 2.2.
//
//   h_v = (L X)_v = gradient of the total area with respect to x_v,    m_v = area around v / 3
//   E_b = 1/2 sum over v in U of |h_v|^2 / m_v,           U: vertices with a complete one-ring
//
// With spontaneous curvature ([W07] section 4), the energy 1/2 * integral of (H - H0)^2 is
// discretized as
//
//   E_b = 1/2 sum over v in U of |h_v - H0_v a_v|^2 / m_v,    a_v = gradient of the volume by x_v
//
// where a_v tends to m_v times the normal. This energy is never negative, and H > 0 on a sphere
// whose triangles are oriented outward. Its Hessian is approximated by the Hessian of the energy
// without H0, which is positive semi-definite.
//
// The energy is consistent with 1/2 * integral of H^2 on any regular triangulation. Its gradient
// vanishes at a fully folded hinge.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/block_loop.h"
#include "ibmfair/energy/lagrange_kernels.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

class Lagrange final : public BendingEnergy {
 public:
  Lagrange(const Topology& topology, const EnergyOptions& options);

  double energy(const Points& X) override;
  double energy_and_gradient(const Points& X, Points& G) override;
  const CompressedRows& stencils() const override { return stencils_; }
  void linearise(const Points& X, StencilWeights& weights) override;

 private:
  void load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const;

  const VertexRoles& roles(const MeshBlock& b) const;

  bool is_spontaneous() const { return spontaneous_.size() > 0; }

  bool mass_;
  PerVertex spontaneous_;           // H0, or empty for none
  CompressedRows stencils_;         // #U rows: the centre, then its ring in cyclic order
  MeshBlocks blocks_;               // the triangles around U
  std::vector<VertexRoles> roles_;  // one per block
  BlockLoop loop_;
};

}  // namespace ibmfair
