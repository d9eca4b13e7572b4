// Shapes made by subdividing the triangles of a small polyhedron: icosahedron and icosphere, cube
// and cubesphere, hexagon. Closed shapes are oriented outward. Subdivision appends vertices: the
// vertices of level n are the first vertices of level n + 1, at bit-identical positions.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// How the faces of a polyhedron are subdivided.
struct Subdivision {
  int levels = 0;  ///< how often every triangle is split into four; at most 12
  /// One face of the polyhedron whose triangles are split once more. The adjacent triangles outside
  /// this face are split in two.
  std::optional<Index> refined_face = {};
};

/// The regular icosahedron with its vertices on the unit sphere and flat faces: 10 * 4^levels + 2
/// vertices, 20 * 4^levels triangles. The triangles of face k of the polyhedron start at k *
/// 4^levels. Area 5 sqrt(3) a^2, volume 5/12 (3 + sqrt 5) a^3 with the edge a = 4 / sqrt(10 + 2
/// sqrt 5). Throws BadOption for levels or a refined face out of range, and if the result is too
/// large.
TriangleMesh make_icosahedron(const Subdivision& subdivision);

/// The connectivity of `make_icosahedron`, with new vertices projected onto the unit sphere after
/// each subdivision. Area 4 pi, volume 4/3 pi, E_b 8 pi in the limit.
TriangleMesh make_icosphere(const Subdivision& subdivision);

/// The cube [-1, 1]^3 of 12 * 4^levels triangles, flat-faced. Area 24, volume 8.
TriangleMesh make_cube(const Subdivision& subdivision);

/// The cube with all vertices projected onto the unit sphere. Triangles are right-angled near the
/// centres of the six sides; near the eight corners they have angles of 60 degrees, or of 30 and
/// 120 degrees. Area 4 pi, volume 4/3 pi, E_b 8 pi in the limit.
TriangleMesh make_cubesphere(const Subdivision& subdivision);

/// The flat regular hexagon with corners on the unit circle in the plane z = 0, oriented towards
/// +z, with 6 * 4^levels equilateral triangles. Area 3/2 sqrt 3, E_b 0.
TriangleMesh make_hexagon(const Subdivision& subdivision);

}  // namespace ibmfair
