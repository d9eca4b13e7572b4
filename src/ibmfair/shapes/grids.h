// Shapes whose vertices form a grid of rows: torus, open cylinder, catenoid, plane. Every other row
// is shifted by half a cell, so that triangles are nearly equilateral; with `straight` no row is
// shifted, and triangles are right-angled.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/shapes/jitter.h"
#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// The size of a grid. A number that is not given is derived from the other one such that triangles
/// are nearly equilateral (with `straight`: right-angled with equal legs) on average. If neither is
/// given, the smaller of the two is 32.
struct GridSize {
  std::optional<Index> rows = {};     ///< number of rows of vertices
  std::optional<Index> columns = {};  ///< vertices in a row
  bool straight = false;
  Jitter jitter = {};  ///< along and across the rows, in cells; ignored by the plane
};

/// The torus about the z axis with radii R = 1 and r = 1 / ratio, ratio > 1, oriented outward. Rows
/// are circles about the axis. Their number is even unless `straight`. Vertex 0 is at (1 + r, 0,
/// 0). Area 4 pi^2 / ratio, volume 2 pi^2 / ratio^2, E_b 2 pi^2 ratio^2 / sqrt(ratio^2 - 1) in the
/// limit; E_b is smallest for the Clifford torus (ratio sqrt 2, E_b 4 pi^2). Throws BadOption for
/// an invalid ratio or size.
TriangleMesh make_torus(double ratio, const GridSize& size);

/// The open cylinder of radius 1 about the z axis from z = -height/2 to height/2, oriented outward.
/// Rows are circles, starting at the bottom. Area 2 pi height, E_b pi height in the limit (H = 1;
/// the boundary carries no energy). Throws BadOption for an invalid height or size.
TriangleMesh make_cylinder(double height, const GridSize& size);

/// The catenoid (cosh z cos u, cosh z sin u, z) from z = -height/2 to height/2, oriented outward.
/// Rows are circles, starting at the bottom. Apart from the effect of curvature, the triangles have
/// the angles of the flat grid. Area pi (height + sinh height), E_b 0 in the limit. Throws
/// BadOption for an invalid height or size, and for a height above 20.
TriangleMesh make_catenoid(double height, const GridSize& size);

/// The rectangle [0, 1] x [0, height] in the plane z = 0, oriented towards +z. Rows run along x;
/// shifted rows end with half cells, so that the boundary is straight. Area `height`, E_b 0. Throws
/// BadOption for an invalid height or size.
TriangleMesh make_plane(double height, const GridSize& size);

}  // namespace ibmfair
