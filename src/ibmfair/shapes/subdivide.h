// Splitting triangles at the midpoints of their edges.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Triangles and their vertices, #V x 3 and #F x 3.
struct TriangleMesh {
  Points X;
  Triangles F;
};

/// Splits the marked triangles (#F) into four each and makes the result conforming by red-green
/// closure: a triangle with two or three split edges is split into four as well, one with a single
/// split edge into two. New vertices are flat midpoints and come after all old ones, which keep
/// their numbers; the children of a triangle take its place in the order. Orientation is kept.
/// Throws BadOption where the result would exceed `largest_shape` faces.
TriangleMesh split_triangles(const TriangleMesh& mesh, std::vector<std::uint8_t> marked);

/// Splits every triangle into four.
TriangleMesh split_all_triangles(const TriangleMesh& mesh);

/// The most faces that a generated shape may have: about 6 GB while it is made and written.
constexpr std::int64_t largest_shape = 50'000'000;

/// Throws BadOption for a face count that is above `largest_shape`.
void require_shape_size(double face_count);

}  // namespace ibmfair
