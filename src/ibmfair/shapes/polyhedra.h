// Shapes that come from splitting the triangles of a small polyhedron: icosahedron and icosphere,
// cube and cubesphere, hexagon. Closed ones are oriented outward. Subdivision appends: the vertices
// of level n are the first ones of level n + 1, at bit-identical positions.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// How a polyhedron's faces are split.
struct Subdivision {
  int levels = 0;  ///< every triangle is split into four, so many times; at most 12
  /// One face of the polyhedron whose triangles are split once more; the neighbours beyond its
  /// border are cut in two.
  std::optional<Index> refined_face = {};
};

/// The regular icosahedron with its vertices on the unit sphere and flat faces: 10 * 4^levels + 2
/// vertices, 20 * 4^levels triangles. Face k of the polyhedron is triangles k * 4^levels onward.
/// Area 5 sqrt(3) a^2, volume 5/12 (3 + sqrt 5) a^3 with the edge a = 4 / sqrt(10 + 2 sqrt 5).
/// Throws BadOption for levels or a refined face out of range, and for a result that is too large.
TriangleMesh make_icosahedron(const Subdivision& subdivision);

/// The connectivity of `make_icosahedron`, with each new vertex put on the unit sphere after each
/// splitting. Area 4 pi, volume 4/3 pi, E_b 8 pi in the limit.
TriangleMesh make_icosphere(const Subdivision& subdivision);

/// The cube [-1, 1]^3 of 12 * 4^levels triangles, flat-faced. Area 24, volume 8.
TriangleMesh make_cube(const Subdivision& subdivision);

/// The cube with all vertices put on the unit sphere: near the middles of
/// the six sides triangles are right-angled, near the eight corners they have 60 or 30 and 120
/// degrees. Area 4 pi, volume 4/3 pi, E_b 8 pi in the limit.
TriangleMesh make_cubesphere(const Subdivision& subdivision);

/// The flat regular hexagon with corners on the unit circle in the plane z = 0, seen from above, of
/// 6 * 4^levels equilateral triangles. Area 3/2 sqrt 3, E_b 0.
TriangleMesh make_hexagon(const Subdivision& subdivision);

}  // namespace ibmfair
