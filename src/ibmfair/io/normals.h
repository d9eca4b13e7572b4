// Vertex normals of a polygon mesh, and which of them moving some vertices makes stale.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Twice the area vector of a polygon, planar or not.
Vec3 polygon_area_vector(const Points& X, std::span<const Index> corners);

/// #V x 3, the mean of the normals around each vertex weighted by area, of length 1; zero where
/// there is none.
Points vertex_normals(const Polygons& faces, const Points& X);

/// #faces, 1 where a corner is in `vertices`.
std::vector<std::uint8_t> faces_touching(const Polygons& faces,
                                         const std::vector<std::uint8_t>& vertices);

/// Stands in for the normals that a file gives its vertices once some of those have moved.
class RenewedNormals {
 public:
  RenewedNormals(const Polygons& faces, const Points& before, const Points& after,
                 const std::vector<std::uint8_t>& moved);

  /// Whether a face around the vertex has changed.
  bool is_stale(std::int64_t vertex) const { return stale_[static_cast<std::size_t>(vertex)] != 0; }

  /// The new normal, on the side of the surface on which `old`, the file's own, was before. Without
  /// faces of any area around the vertex it is `old` itself.
  Vec3 renew(std::int64_t vertex, const Vec3& old) const;

 private:
  std::vector<std::uint8_t> stale_;
  Points before_;
  Points after_;
};

}  // namespace ibmfair
