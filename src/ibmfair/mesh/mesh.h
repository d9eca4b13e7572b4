// A polygon mesh as it stands in a file: positions and faces, nothing merged, nothing reordered.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Vertices, faces and triangles that a mesh may have at most, so that Index can number all that
/// belongs to it: triangles have three edges each where they share none, edges two ends each.
inline constexpr std::int64_t most_elements = std::numeric_limits<Index>::max() / 6;

/// Faces of any number of corners, stored one after the other.
struct Polygons {
  std::vector<std::int64_t> first{0};  ///< face f has corners first[f] .. first[f + 1] - 1
  std::vector<Index> corner;           ///< vertex numbers

  Index size() const { return static_cast<Index>(first.size()) - 1; }

  std::span<const Index> operator[](Index f) const {
    return {corner.data() + first[f], static_cast<std::size_t>(first[f + 1] - first[f])};
  }

  void add(std::span<const Index> corners) {
    corner.insert(corner.end(), corners.begin(), corners.end());
    first.push_back(static_cast<std::int64_t>(corner.size()));
  }
};

/// Positions (#V x 3) and faces whose corners are in 0 .. #V - 1.
struct Mesh {
  Points X;
  Polygons faces;
};

/// The triangles that the solver sees, and the polygon that each came from.
struct Triangulation {
  Triangles F;              ///< #F x 3, in the order of the faces, each with its face's orientation
  std::vector<Index> face;  ///< #F, the polygon of each triangle
};

/// Splits every face into triangles: a triangle stays as it is, a quadrilateral is cut along the
/// diagonal that leaves the larger smallest angle, larger polygons are cut ear by ear in their
/// best-fit plane, so that concave faces do not fold over. Faces with a repeated corner are kept
/// (as triangles that may repeat a corner too): leaving them out is the topology's decision.
Triangulation triangulate(const Mesh& mesh);

/// A mesh of these triangles, as shapes and tests make it.
Mesh mesh_from_triangles(Points X, const Triangles& F);

}  // namespace ibmfair
