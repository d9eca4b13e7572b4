// The border of a sheet along the creases that bound it, and how the sheet would go on beyond them.
#pragma once

#include <vector>

#include "ibmfair/fill/crease_network.h"

namespace ibmfair {

/// A crease on the border of a sheet, in the direction in which the sheet lies to its left.
struct BorderCurve {
  Index curve = -1;  ///< number in the network
  bool reversed = false;
  CurvePoints points;
  Points beyond;  ///< one row per point: a place beyond the crease to which the sheet would go on
  Index end_before = -1;  ///< the crease end at which it begins; -1 for a corner
  Index end_after = -1;   ///< the crease end at which it ends; -1 for a corner
  /// Turn to the next curve of the border at the corner at which this one ends, radians; positive
  /// to the left.
  double turn = 0;
};

/// The creases on the border of a sheet, in order. A sheet goes on beyond a crease in its tangent
/// plane, which is known at the rim, and at corners from the directions of both creases; in
/// between, it turns evenly.
std::vector<BorderCurve> border_curves(const CreasedRim& rim, const CreaseNetwork& network,
                                       const std::vector<SheetSide>& sheet);

/// The unit normal of the sheet, averaged over its arcs and their ends.
Vec3 mean_normal(const CreasedRim& rim, const std::vector<SheetSide>& sheet);

}  // namespace ibmfair
