// The vertex-based member of the family, with linear Lagrange elements and lumped mass: the
// cotangent Laplacian, [W07] section 2.2.
//
//   h_v = (L X)_v = gradient of the total area with respect to x_v,    m_v = area around v / 3
//   E_b = 1/2 sum over v in U of |h_v|^2 / m_v,           U: vertices with a complete one-ring
//
// Consistent with 1/2 * integral of H^2 on any regular triangulation, and with a stationary limit;
// at a fully folded hinge its force vanishes.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/triangle_frames.h"

namespace ibmfair {

class Lagrange final : public BendingEnergy {
 public:
  Lagrange(const Topology& topology, const EnergyOptions& options);

  double energy(const Points& X) override;
  double energy_and_gradient(const Points& X, Points& G) override;
  const Rows& stencils() const override { return stencils_; }
  void linearise(const Points& X, StencilWeights& weights) override;

 private:
  void update_curvature(const Points& X);
  double star_energy(Index s) const;
  void triangle_gradient(const Points& X, Index t);

  bool mass_;
  std::vector<Index> centre_;                      // #U: the vertices that carry a stencil
  std::vector<Index> star_of_;                     // #V: the stencil around each vertex, or -1
  Rows stencils_;                                  // #U: the centre, then its ring
  Triangles F_;                                    // the triangles around U
  Rows places_;                                    // #V rows of 3 * triangle + place
  std::vector<std::array<Index, 2>> ring_places_;  // for each corner of F_: positions in stencils_
                                                   // of the next and the one after, or -1
  std::vector<TriangleFrame> triangle_;
  std::vector<Vec3> h_;                      // #U: integrated mean curvature vector, length
  std::vector<double> m_;                    // #U: lumped mass, length^2
  std::vector<std::array<Vec3, 3>> forces_;  // the gradient gathered from each triangle
};

}  // namespace ibmfair
