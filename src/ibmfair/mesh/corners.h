// Relations between a triangle and its corners. These functions avoid branches, because the
// processor cannot predict which corner a given vertex is.
#pragma once

#include <array>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The place (0, 1, 2) of vertex v in triangle t; v must be a corner of t.
inline int place_of(const Triangles& F, Index t, Index v) {
  return F(t, 0) == v ? 0 : F(t, 1) == v ? 1 : 2;
}

/// Whether b follows a in the cyclic order of the corners of triangle t.
inline bool runs_along(const Triangles& F, Index t, Index a, Index b) {
  const Index x = F(t, 0), y = F(t, 1), z = F(t, 2);
  return ((x == a) & (y == b)) | ((y == a) & (z == b)) | ((z == a) & (x == b));
}

/// The third corner of triangle t, of which a and b must be two corners.
inline Index opposite_vertex(const Triangles& F, Index t, Index a, Index b) {
  return F(t, 0) ^ F(t, 1) ^ F(t, 2) ^ a ^ b;
}

/// The two corners of triangle t that follow v in the triangle's cyclic order; v must be a corner
/// of t.
inline std::array<Index, 2> other_corners(const Triangles& F, Index t, Index v) {
  const Index x = F(t, 0), y = F(t, 1), z = F(t, 2);
  return {x == v ? y : y == v ? z : x, x == v ? z : y == v ? x : y};
}

/// Whether triangle t names a vertex twice.
inline bool repeats_corner(const Triangles& F, Index t) {
  const Index x = F(t, 0), y = F(t, 1), z = F(t, 2);
  return (x == y) | (y == z) | (z == x);
}

}  // namespace ibmfair
