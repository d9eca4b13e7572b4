// Vertex normals of a polygon mesh, and which of them change when some vertices move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Twice the area vector of a polygon, whether or not it is planar.
Vec3 polygon_area_vector(const Points& X, std::span<const Index> corners);

/// Unit vertex normals, #V x 3: the direction of the area-weighted mean of the normals around each
/// vertex; zero if there is no area.
Points vertex_normals(const Polygons& faces, const Points& X);

/// #faces, 1 for each face with a corner in `vertices`.
std::vector<std::uint8_t> faces_touching(const Polygons& faces,
                                         const std::vector<std::uint8_t>& vertices);

/// Computes new vertex normals for a file with normals after some vertices have moved.
class RenewedNormals {
 public:
  RenewedNormals(const Polygons& faces, const Points& before, const Points& after,
                 const std::vector<std::uint8_t>& moved);

  /// Whether a face at the vertex has changed, so that the vertex needs a new normal.
  bool is_stale(std::int64_t vertex) const { return stale_[vertex] != 0; }

  /// The new normal, oriented so that it is on the same side of the surface as `old`, the normal in
  /// the file, was before the move. If the faces at the vertex have no area, the result is `old`.
  Vec3 renew(std::int64_t vertex, const Vec3& old) const;

 private:
  std::vector<std::uint8_t> stale_;
  Points before_;
  Points after_;
};

}  // namespace ibmfair
