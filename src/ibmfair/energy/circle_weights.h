// Vertex weights of weighted triangulations that change with the positions of the mesh.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The squared radii of circles about the vertices. r_v is the mean over the triangles at v of half
/// the mean length of their two edges at v. On a circle packing, where the circles of neighbours
/// touch, these radii are exact: the centre of every triangle is then the centre of its inscribed
/// circle, and so all edge weights are positive. A mesh is the closer to this case the more
/// gradually its edge lengths change. The weights scale with length^2 and are intrinsic.
class CircleWeights {
 public:
  explicit CircleWeights(const Topology& topology);

  /// w_v = r_v^2, #V; 0 at a vertex without usable triangles.
  const PerVertex& at(const Points& X);

  /// Adds to G, #V x 3, the gradient of a function of the weights at X, given the derivatives of
  /// the function with respect to the weights (#V). Precondition: X is the state of the last call
  /// of `at`.
  void pull_back(const Points& X, const PerVertex& by_weight, Points& G) const;

 private:
  Triangles F_;           // the usable triangles
  CompressedRows stars_;  // #V, rows of F_
  PerVertex radius_, weight_;
};

}  // namespace ibmfair
