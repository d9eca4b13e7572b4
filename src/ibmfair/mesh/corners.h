// Places within a triangle. Nothing here branches: which of its corners a vertex is cannot be
// foreseen.
#pragma once

#include <array>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The place (0, 1, 2) of vertex v in triangle t, which must have it.
inline int place_of(const Triangles& F, Index t, Index v) {
  return F(t, 0) == v ? 0 : F(t, 1) == v ? 1 : 2;
}

/// Whether triangle t runs through its corners ... a, b ...
inline bool runs_along(const Triangles& F, Index t, Index a, Index b) {
  const Index x = F(t, 0), y = F(t, 1), z = F(t, 2);
  return ((x == a) & (y == b)) | ((y == a) & (z == b)) | ((z == a) & (x == b));
}

/// The corner of triangle t, which has both, that is neither a nor b.
inline Index opposite_vertex(const Triangles& F, Index t, Index a, Index b) {
  return F(t, 0) ^ F(t, 1) ^ F(t, 2) ^ a ^ b;
}

/// The two corners of triangle t, which has v, that come after v, in the triangle's order.
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
