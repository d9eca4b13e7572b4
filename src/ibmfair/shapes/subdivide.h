// Splitting triangles at the midpoints of their edges.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A triangle mesh: vertex positions X, #V x 3, and triangles F, #F x 3.
struct TriangleMesh {
  Points X;
  Triangles F;
};

/// Splits the marked triangles (#F) into four each and makes the result conforming by red-green
/// closure: a triangle with two or three split edges is also split into four, and a triangle with
/// one split edge into two. New vertices are midpoints of straight edges and come after all old
/// vertices, which keep their numbers. The children of a triangle take its place in the order.
/// Orientation is kept. Throws BadOption if the result would exceed `largest_shape` faces.
TriangleMesh split_triangles(const TriangleMesh& mesh, std::vector<std::uint8_t> marked);

/// Splits every triangle into four.
TriangleMesh split_all_triangles(const TriangleMesh& mesh);

/// The most faces that a generated shape may have; making and writing such a shape takes about 6
/// GB.
constexpr std::int64_t largest_shape = 50'000'000;

/// Throws BadOption for a face count that is above `largest_shape`.
void require_shape_size(double face_count);

}  // namespace ibmfair
