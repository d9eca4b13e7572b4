// The vertex-based Laplacians of the family: [W07] section 2.2. L_pq = -(sum of what the triangles
// at the edge pq give it), L_pp = -sum over q of L_pq, so that constants are in the kernel.
#pragma once

#include "ibmfair/energy/material_directions.h"
#include "ibmfair/energy/triangle_shape.h"

namespace ibmfair {

/// A vertex-based Laplacian.
struct VertexLaplacian {
  TriangleFormula edge_weights;  ///< what a triangle gives its edges, dimensionless
  bool circle_weights = false;   ///< the formula sees weights of vertices (energy/circle_weights.h)
  bool directions = false;       ///< the formula sees EnergyOptions::material_directions
  bool flips = false;  ///< on the intrinsic Delaunay triangulation (energy/intrinsic_delaunay.h)
};

/// Half the cotangents of the opposite angles: linear Lagrange elements.
struct CotangentWeights {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    return {0.5 * t.cot[0], 0.5 * t.cot[1], 0.5 * t.cot[2]};
  }
};

/// Dual over primal lengths of a weighted triangulation, [W07] (6), after D. Glickenstein,
/// "Geometric triangulations and discrete Laplacians on manifolds" (2005). The centre of triangle
/// ijk has the same power |c - x|^2 - w to its three corners; its signed height over the edge ij is
///
///   h_ij / l_ij = 1/2 (cot k + (cot j w_i + cot i w_j) / l_ij^2 - w_k / (2 A))
///
/// Equal weights move no centre from the circumcentre: they give the cotangents. Positive
/// semi-definite where every centre lies within the circumcircle.
struct PowerCentreWeights {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    ByCorner<Number> result;
    for (int k = 0; k < 3; ++k) {
      const int i = next(k), j = previous(k);
      result[k] =
          0.5 * (t.cot[k] + (t.cot[j] * t.weight[i] + t.cot[i] * t.weight[j]) / t.squared[k] -
                 0.5 * t.weight[k] / t.area);
    }
    return result;
  }
};

/// Second derivatives along a material direction and across it, [W07] (14): with v = sum_i rate_i
/// x_i, along which a function u has the derivative u_v = sum_i rate_i u_i / |v|, the Dirichlet
/// form of c u_v^2 + (|grad u|^2 - u_v^2). With the factor c = 1 these are the cotangents. Under
/// isometry L X is the curvature vector plus a part within the surface from directions that turn,
/// whose length does not change.
struct DirectionalWeights {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    const auto& [rate, factor] = *t.direction;
    const ByCorner<double> pairs{rate[1] * rate[2], rate[2] * rate[0], rate[0] * rate[1]};
    // |v|^2, as the rates sum to 0
    const Number stretch =
        -pairs[0] * t.squared[0] - pairs[1] * t.squared[1] - pairs[2] * t.squared[2];
    ByCorner<Number> result = CotangentWeights::at(t);
    for (int k = 0; k < 3; ++k) {
      result[k] = result[k] - ((factor - 1) * pairs[k]) * t.area / stretch;
    }
    return result;
  }
};

/// The graph Laplacian: every edge weighs 1, half from either triangle. Not zero on planes.
struct UmbrellaWeights {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>&) {
    return {Number(0.5), Number(0.5), Number(0.5)};
  }
};

inline constexpr VertexLaplacian cotangent_laplacian{triangle_formula<CotangentWeights>};
inline constexpr VertexLaplacian weighted_laplacian{triangle_formula<PowerCentreWeights>, true};
inline constexpr VertexLaplacian directional_laplacian{
    .edge_weights = triangle_formula<DirectionalWeights>, .directions = true};
inline constexpr VertexLaplacian umbrella_laplacian{triangle_formula<UmbrellaWeights>};
inline constexpr VertexLaplacian intrinsic_delaunay_laplacian{
    .edge_weights = triangle_formula<CotangentWeights>, .flips = true};

}  // namespace ibmfair
