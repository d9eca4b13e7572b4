// The intrinsic Delaunay triangulation of a mesh: the Delaunay triangulation of its vertices in its
// own metric, found by flipping edges within the surface. A. Bobenko, B. Springborn, "A discrete
// Laplace-Beltrami operator for simplicial surfaces" (2007): it depends on nothing but the metric,
// and no edge of it has a negative cotangent weight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Edges flip where two usable triangles meet; all others stay. Triangles of the result can have a
/// vertex twice, and two vertices more than one edge.
class IntrinsicDelaunay {
 public:
  explicit IntrinsicDelaunay(const Topology& topology);

  /// Flips from the mesh's own triangles at X until no edge has opposite angles that add up to more
  /// than pi. Precondition: usable triangles have areas.
  void triangulate(const Points& X);

  /// The corners of the triangles, one for each usable triangle of the mesh.
  const Triangles& corners() const { return corners_; }
  const std::vector<TriangleShape<double>>& shapes() const { return shapes_; }
  /// The edges opposite the corners, numbered as in Topology::E; a flipped edge keeps its number.
  const Triangles& sides() const { return sides_; }
  std::int64_t flips() const { return static_cast<std::int64_t>(flips_.size()); }

  /// Takes the derivatives of a function by the squared lengths of the edges (#E) to those by the
  /// squared lengths of the mesh's own edges: back over the flips.
  void pull_back(std::vector<double>& by_squared) const;

 private:
  /// The length of a diagonal of a plane quadrilateral as a function of the other five.
  struct Flip {
    std::array<Index, 5> edge;    // the diagonal, before and after, then the four sides
    std::array<double, 5> slope;  // of the new squared length by the old ones
  };
  using Sides = std::array<Index, 2>;  // places 3 t + i of an edge, or -1

  bool is_delaunay(Index e) const;
  void flip(Index e, std::vector<Index>& waiting);
  void reverse(Index t);
  Index& side_at(Index e, Index place);

  Triangles mesh_corners_, mesh_sides_;
  std::vector<Sides> mesh_places_;
  std::vector<std::uint8_t> mesh_twisted_;

  Triangles corners_, sides_;
  std::vector<Sides> places_;
  std::vector<std::uint8_t> twisted_;  // the edge's triangles run along it in the same direction
  std::vector<TriangleShape<double>> shapes_;
  std::vector<Flip> flips_;
};

}  // namespace ibmfair
