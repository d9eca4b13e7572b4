// What a vertex-based Laplacian and its mass are made of, triangle by triangle, at one state.
#pragma once

#include <memory>
#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/energy/circle_weights.h"
#include "ibmfair/energy/intrinsic_delaunay.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/energy/vertex_laplacians.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The triangles that may carry a stencil, in their order.
Triangles usable_triangles(const Topology& topology);

/// Their sides: the edges opposite their corners, rows of Topology::E.
Triangles usable_sides(const Topology& topology);

/// What a triangle adds to L, by the edges opposite its corners, and to M, by its corners.
struct TriangleTerms {
  ByCorner<double> edge, corner;
};

/// Derivatives of a function by the squared lengths of a triangle's edges and by its vertices'
/// weights.
struct TriangleSlopes {
  ByCorner<double> by_squared, by_weight;
};

class VertexTriangles {
 public:
  /// Of the triangles that are `kept` (#F); all usable ones where edges flip. Throws BadOption
  /// where the options have not one finite weight for every vertex.
  VertexTriangles(const Topology& topology, const VertexLaplacian& laplacian,
                  const MassMatrix& mass, const EnergyOptions& options,
                  const std::vector<std::uint8_t>& kept);

  /// Goes to the state X. All below belongs to that state.
  void measure(const Points& X);

  const Triangles& corners() const { return delaunay_ ? delaunay_->corners() : corners_; }
  const std::vector<TriangleShape<double>>& shapes() const {
    return delaunay_ ? delaunay_->shapes() : shapes_;
  }
  const std::vector<TriangleTerms>& terms() const { return terms_; }

  /// Calls act(t, i) for every triangle t whose corner i is v, in a fixed order.
  template <class Act>
  void around(Index v, Act&& act) const {
    for (const Index place : places_[v]) {
      act(place / 3, place % 3);
    }
  }

  /// What a triangle of the mesh itself, with these vertices, adds to L and M: the same unless
  /// edges flip.
  TriangleTerms terms_of(const Points& X, Index v0, Index v1, Index v2) const;

  /// The derivatives of a function of the terms of triangle t, from those by the terms.
  TriangleSlopes slopes(Index t, const TriangleTerms& by_terms) const;

  /// Adds to G, #V x 3, the gradient of a function of the triangles' metric from its slopes, which
  /// are used up.
  void pull_back(const Points& X, std::vector<TriangleSlopes>& slopes, Points& G) const;

 private:
  TriangleTerms terms_at(const TriangleShape<double>& shape) const;
  MaterialDirection direction_of(Index v0, Index v1, Index v2) const;

  TriangleFormula edge_weights_, shares_, mesh_shares_;
  Triangles corners_;
  std::vector<TriangleShape<double>> shapes_;
  std::vector<TriangleTerms> terms_;
  Rows places_;  // #V rows of 3 t + i
  std::vector<MaterialDirection>
      directions_;     // like corners_, or empty where the formula sees none
  PerVertex weights_;  // #V, or empty where the formula sees none
  std::unique_ptr<CircleWeights> circles_;
  std::unique_ptr<IntrinsicDelaunay> delaunay_;
  Edges edges_;     // #E x 2, where edges flip
  Rows edge_ends_;  // #V rows of 2 e + end
};

}  // namespace ibmfair
