// The vertex-based Laplacians of the family: [W07] section 2.2. L_pq = -(sum of the contributions
// of the triangles at the edge pq) and L_pp = -sum over q of L_pq, so that constants are in the
// kernel.
#pragma once

#include "ibmfair/energy/material_directions.h"
#include "ibmfair/energy/triangle_shape.h"

namespace ibmfair {

/// A vertex-based Laplacian.
struct VertexLaplacian {
  TriangleFormula edge_weights;  ///< a triangle's contribution to its edges, dimensionless
  bool circle_weights = false;   ///< the formula uses vertex weights (energy/circle_weights.h)
  bool directions = false;       ///< the formula uses EnergyOptions::material_directions
  bool flips = false;  ///< uses the intrinsic Delaunay triangulation (energy/intrinsic_delaunay.h)
};

/// Half the cotangents of the angles opposite the edges: linear Lagrange elements.
struct CotangentWeights {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    return {0.5 * t.cot[0], 0.5 * t.cot[1], 0.5 * t.cot[2]};
  }
};

/// The ratio of dual to primal edge lengths in a weighted triangulation, [W07] (6), after D.
/// Glickenstein, "Geometric triangulations and discrete Laplacians on manifolds" (2005). The centre
/// c of triangle ijk has the same power |c - x|^2 - w with respect to its three corners. Its signed
/// height over the edge ij is given by
///
///   h_ij / l_ij = 1/2 (cot k + (cot j w_i + cot i w_j) / l_ij^2 - w_k / (2 A))
///
/// If all weights are equal, the centre is the circumcentre and the formula gives the cotangent
/// weights. The Laplacian is positive semi-definite if every centre lies within its triangle's
/// circumcircle.
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

/// Second derivatives along and across a material direction, [W07] (14). The direction is v = sum_i
/// rate_i x_i, and the derivative of a function u along it is u_v = sum_i rate_i u_i / |v|. The
/// weights are those of the Dirichlet form of c u_v^2 + (|grad u|^2 - u_v^2); with the factor c = 1
/// they are the cotangent weights. Under isometry, L X is the curvature vector plus a part within
/// the surface. This part comes from directions that turn within the surface, and its length does
/// not change.
struct DirectionalWeights {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    const auto& [rate, factor] = *t.direction;
    const ByCorner<double> pairs{rate[1] * rate[2], rate[2] * rate[0], rate[0] * rate[1]};
    // |v|^2; this formula holds because the rates sum to 0
    const Number stretch =
        -pairs[0] * t.squared[0] - pairs[1] * t.squared[1] - pairs[2] * t.squared[2];
    ByCorner<Number> result = CotangentWeights::at(t);
    for (int k = 0; k < 3; ++k) {
      result[k] = result[k] - ((factor - 1) * pairs[k]) * t.area / stretch;
    }
    return result;
  }
};

/// The graph Laplacian: every edge has weight 1, half from each of its two triangles. Not zero on
/// planes.
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
