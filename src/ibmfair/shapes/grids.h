// Shapes that are rows of vertices: torus, open cylinder, catenoid, plane. Every other row is
// shifted by half a cell, so that triangles are near equilateral, unless `straight` asks for
// right-angled ones.
#pragma once

#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/shapes/jitter.h"
#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// The size of a grid. A number that is not given follows from the other so that triangles are near
/// equilateral (right-angled with equal legs if straight) on average; with neither, the smaller of
/// the two is 32.
struct GridSize {
  std::optional<Index> rows = {};     ///< of vertices
  std::optional<Index> columns = {};  ///< vertices in a row
  bool straight = false;
  Jitter jitter = {};  ///< along the rows and across, in cells; not of a plane
};

/// The torus about the z axis with radii R = 1 and r = 1 / ratio, ratio > 1, oriented outward. Rows
/// are circles about the axis, an even number of them around the tube unless straight; vertex 0 is
/// at (1 + r, 0, 0). Area 4 pi^2 / ratio, volume 2 pi^2 / ratio^2, E_b
/// 2 pi^2 ratio^2 / sqrt(ratio^2 - 1) in the limit, smallest for the Clifford torus (ratio sqrt 2,
/// E_b 4 pi^2). Throws BadOption for a ratio or a size that cannot be.
TriangleMesh make_torus(double ratio, const GridSize& size);

/// The open cylinder of radius 1 about the z axis from z = -height/2 to height/2, oriented outward.
/// Rows are circles, from the bottom. Area 2 pi height, E_b pi height in the limit (H = 1; the
/// boundary carries no energy). Throws BadOption as above.
TriangleMesh make_cylinder(double height, const GridSize& size);

/// The catenoid (cosh z cos u, cosh z sin u, z) from z = -height/2 to height/2, oriented outward.
/// Rows are circles, from the bottom; angles are those of the grid, but for its curvature. Area
/// pi (height + sinh height), E_b 0 in the limit. Throws BadOption as above, and for a height above
/// 20.
TriangleMesh make_catenoid(double height, const GridSize& size);

/// The rectangle [0, 1] x [0, height] in the plane z = 0, seen from above. Rows run along x;
/// shifted ones end with half cells, so that the border is straight. Area `height`, E_b 0. Throws
/// BadOption as above.
TriangleMesh make_plane(double height, const GridSize& size);

}  // namespace ibmfair
