// The intrinsic Delaunay triangulation of a mesh: the Delaunay triangulation of its vertices in the
// intrinsic metric of the mesh, found by flipping edges within the surface. A. Bobenko, B.
// Springborn, "A discrete Laplace-Beltrami operator for simplicial surfaces" (2007): the
// triangulation depends only on the metric, and none of its edges has a negative cotangent weight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ibmfair/energy/triangle_shape.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// An edge can flip if exactly two triangles meet at it and both are usable; no other edge flips. A
/// triangle of the result can contain the same vertex twice, and two vertices can share more than
/// one edge.
class IntrinsicDelaunay {
 public:
  explicit IntrinsicDelaunay(const Topology& topology);

  /// Starts from the mesh's own triangles at X and flips edges until no edge has opposite angles
  /// that add up to more than pi. Precondition: usable triangles have positive area.
  void triangulate(const Points& X);

  /// The corners of the triangles, one for each usable triangle of the mesh.
  const Triangles& corners() const { return corners_; }
  const std::vector<TriangleShape<double>>& shapes() const { return shapes_; }
  /// The edges opposite the corners, numbered as in Topology::E; a flipped edge keeps its number.
  const Triangles& sides() const { return sides_; }
  std::int64_t flips() const { return static_cast<std::int64_t>(flips_.size()); }

  /// Converts the derivatives of a function with respect to the squared edge lengths of the
  /// triangulation (#E) to those with respect to the squared edge lengths of the mesh, in place.
  /// The flips are differentiated in reverse order.
  void pull_back(std::vector<double>& by_squared) const;

 private:
  /// A flip, with the squared length of the new diagonal as a function of the other five.
  struct Flip {
    std::array<Index, 5> edge;  // the diagonal (same number before and after), then the four sides
    std::array<double, 5> slope;  // derivatives of the new squared length by the old ones
  };
  using Sides = std::array<Index, 2>;  // the two places 3 t + i of an edge, or -1

  bool is_delaunay(Index e) const;
  void flip(Index e, std::vector<Index>& waiting);
  void reverse(Index t);
  Index& side_at(Index e, Index place);

  Triangles mesh_corners_, mesh_sides_;
  std::vector<Sides> mesh_places_;
  std::vector<std::uint8_t> mesh_twisted_;

  Triangles corners_, sides_;
  std::vector<Sides> places_;
  std::vector<std::uint8_t> twisted_;  // both triangles traverse the edge in the same direction
  std::vector<TriangleShape<double>> shapes_;
  std::vector<Flip> flips_;
};

}  // namespace ibmfair
