// The edge-based member of the family, [W07] Theorem 3 and appendix: one stencil per hinge (an
// interior edge with its two triangles).
//
// On the hinge x0, x1 (edge), x2, x3 (opposite vertices), with A the area of its two triangles and
// theta the dihedral angle (pi when flat):
//
//   E_hinge = 3/(2A) |c0 x0 + c1 x1 + c2 x2 + c3 x3|^2 = 3 |e0|^2 / A (1 + cos theta)
//
// The limit of the energy under refinement depends on the triangulation (equilateral triangles: 3/4
// of the integral of H^2 minus the integral of K). Its gradient does not vanish at folded
// triangles.
//
// With EnergyOptions::sharp_angle, u = E_hinge is replaced by u / (1 + u / u0), where u0 is the
// energy of a hinge of two equilateral triangles that turns by this angle. Where u is much below
// u0, nothing changes; on sharper hinges the gradient and the contribution to the Hessian decrease
// as 1/u^2. Bounding u, and not only 1 + cos theta, also bounds the part of the gradient within the
// surface.
#pragma once

#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/block_loop.h"
#include "ibmfair/energy/crouzeix_raviart_kernels.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

class CrouzeixRaviart final : public BendingEnergy {
 public:
  CrouzeixRaviart(const Topology& topology, const EnergyOptions& options);

  double energy(const Points& X) override;
  double energy_and_gradient(const Points& X, Points& G) override;
  double max_dihedral_turn() const override;
  std::vector<std::uint8_t> near_turns(double turn) const override;
  const CompressedRows& stencils() const override { return stencils_; }
  void linearise(const Points& X, StencilWeights& weights) override;

 private:
  /// If `G` is not null, leaves the gradient of the block's energy in the sums of
  /// `scratch.vertices`.
  double block_energy(const MeshBlock& b, const Points& X, const Points* G, BlockScratch& scratch);

  HingeTerms terms_;
  CompressedRows stencils_;  // #H rows of four
  MeshBlocks blocks_;        // the triangles at the hinges
  BlockLoop loop_;
  std::vector<double> turns_;  // largest 1 + cos(theta) per block, last evaluation
};

}  // namespace ibmfair
