// Weights of vertices for weighted triangulations that follow the mesh.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The squared radii of circles about the vertices, r_v the mean over the triangles at v of half
/// the mean length of their two edges there. On a circle packing, where the circles of neighbours
/// touch, the radii are exact, the centre of every triangle is that of its inscribed circle, and so
/// all weights of edges are positive; the more evenly edge lengths change, the closer any mesh
/// comes to that. The weights scale with length^2 and are intrinsic.
class CircleWeights {
 public:
  explicit CircleWeights(const Topology& topology);

  /// w_v = r_v^2, #V; 0 at a vertex without usable triangles.
  const PerVertex& at(const Points& X);

  /// Adds to G, #V x 3, the gradient of a function of the weights at X, the last state that `at`
  /// was called for, from its derivatives by them (#V).
  void pull_back(const Points& X, const PerVertex& by_weight, Points& G) const;

 private:
  Triangles F_;  // usable
  Rows stars_;   // #V, rows of F_
  PerVertex radius_, weight_;
};

}  // namespace ibmfair
