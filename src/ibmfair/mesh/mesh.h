// A polygon mesh as a file stores it: positions and faces, with nothing merged or reordered.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The largest number of vertices, faces or triangles that a mesh may have, so that Index can
/// number everything derived from the mesh: each triangle has up to three edges of its own, and
/// each edge has two ends.
inline constexpr std::int64_t most_elements = std::numeric_limits<Index>::max() / 6;

/// Faces with any number of corners, stored one after the other.
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

/// The triangles that the solver works on, and the polygon that each triangle came from.
struct Triangulation {
  Triangles F;              ///< #F x 3, in the order of the faces, each with its face's orientation
  std::vector<Index> face;  ///< #F, the polygon of each triangle
};

/// Splits every face into triangles. A triangle stays as it is; a quadrilateral is cut along the
/// diagonal that gives the larger smallest angle; a larger polygon is cut ear by ear in its
/// best-fit plane, so that concave faces do not fold over. Faces with a repeated corner are kept,
/// and their triangles may repeat a corner as well: build_topology() decides which triangles to
/// leave out.
Triangulation triangulate(const Mesh& mesh);

/// A mesh with these positions and triangles, for generated shapes and tests.
Mesh mesh_from_triangles(Points X, const Triangles& F);

}  // namespace ibmfair
