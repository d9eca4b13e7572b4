// The meshes of [W07] Figure 7: the unit square in the plane z = 0, seen from above.
#pragma once

#include <span>
#include <string_view>

#include "ibmfair/shapes/subdivide.h"

namespace ibmfair::cloth {

struct SheetMesh {
  std::string_view name;  ///< "regular" or "irregular"
  TriangleMesh (*make)(Index vertices);
};

/// A grid of rows and columns, all diagonals parallel; as many vertices as the square number
/// nearest to `vertices`.
TriangleMesh regular_sheet(Index vertices);

/// The Delaunay triangulation of exactly `vertices` points: evenly spaced ones on the border, and a
/// jittered additive recurrence of low discrepancy within. The result is always the same, byte for
/// byte.
TriangleMesh irregular_sheet(Index vertices);

std::span<const SheetMesh> sheet_meshes();

}  // namespace ibmfair::cloth
