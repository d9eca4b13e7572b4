// The contributions of the triangles to a vertex-based Laplacian and its mass matrix at one state
// of the mesh.
#pragma once

#include <memory>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/energy/circle_weights.h"
#include "ibmfair/energy/intrinsic_delaunay.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/energy/vertex_laplacians.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The triangles that may carry a stencil (Topology::usable), in the order of Topology::F.
Triangles usable_triangles(const Topology& topology);

/// The sides of the usable triangles: the edges opposite the corners, as rows of Topology::E.
Triangles usable_sides(const Topology& topology);

/// The contributions of a triangle to L, by the edges opposite its corners, and to M, by its
/// corners.
struct TriangleTerms {
  ByCorner<double> edge, corner;
};

/// Derivatives of a function with respect to the squared lengths of a triangle's edges and to the
/// weights of its vertices.
struct TriangleSlopes {
  ByCorner<double> by_squared, by_weight;
};

class VertexTriangles {
 public:
  /// For the triangles that are `kept` (#F), or for all usable ones if the Laplacian flips edges.
  /// Throws BadOption unless the options' vertex weights are empty or one finite weight for every
  /// vertex.
  VertexTriangles(const Topology& topology, const VertexLaplacian& laplacian,
                  const MassMatrix& mass, const EnergyOptions& options,
                  const std::vector<std::uint8_t>& kept);

  /// Computes the contributions at the state X. The functions below refer to the X of the last
  /// call.
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

  /// The contributions to L and M of the triangle of the mesh itself with these vertices. They
  /// differ from terms() only if edges flip.
  TriangleTerms terms_of(const Points& X, Index v0, Index v1, Index v2) const;

  /// The derivatives of a function of the terms of triangle t with respect to the metric, given its
  /// derivatives with respect to the terms.
  TriangleSlopes slopes(Index t, const TriangleTerms& by_terms) const;

  /// Adds to G, #V x 3, the gradient of a function of the triangles' metric, given its slopes. May
  /// overwrite `slopes`.
  void pull_back(const Points& X, std::vector<TriangleSlopes>& slopes, Points& G) const;

 private:
  TriangleTerms terms_at(const TriangleShape<double>& shape) const;
  MaterialDirection direction_of(Index v0, Index v1, Index v2) const;

  TriangleFormula edge_weights_, shares_, mesh_shares_;
  Triangles corners_;
  std::vector<TriangleShape<double>> shapes_;
  std::vector<TriangleTerms> terms_;
  CompressedRows places_;  // #V rows of 3 t + i
  // One per row of corners_, or empty if the formula uses no directions.
  std::vector<MaterialDirection> directions_;
  PerVertex weights_;  // #V, or empty if the formula uses no weights
  std::unique_ptr<CircleWeights> circles_;
  std::unique_ptr<IntrinsicDelaunay> delaunay_;
  Edges edges_;               // #E x 2, only if edges flip
  CompressedRows edge_ends_;  // #V rows of 2 e + end
};

}  // namespace ibmfair
