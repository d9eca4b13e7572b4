// Places within a triangle.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The place (0, 1, 2) of vertex v in triangle t, which must have it.
inline int place_of(const Triangles& F, Index t, Index v) {
  return F(t, 0) == v ? 0 : F(t, 1) == v ? 1 : 2;
}

/// Whether triangle t, which has both, runs through its corners ... a, b ...
inline bool runs_along(const Triangles& F, Index t, Index a, Index b) {
  return F(t, (place_of(F, t, a) + 1) % 3) == b;
}

/// The corner of triangle t that is neither a nor b.
inline Index opposite_vertex(const Triangles& F, Index t, Index a, Index b) {
  const std::int64_t sum = std::int64_t{F(t, 0)} + F(t, 1) + F(t, 2);
  return static_cast<Index>(sum - a - b);
}

}  // namespace ibmfair
