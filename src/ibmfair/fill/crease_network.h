// Continues the creases that end at the rim of a hole: which ones are joined, where they meet, and
// which sheets lie between them.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/fill/crease_curves.h"
#include "ibmfair/fill/rim_creases.h"

namespace ibmfair {

/// A crease through the hole between two nodes. Nodes are the ends of creases at the rim, by their
/// number in CreasedRim::ends, followed by the corners.
struct CreaseCurve {
  Index from = 0, to = 0;
  CurvePoints points;  ///< from node to node
};

/// A part of the border of a sheet; the sheet lies to its left.
struct SheetSide {
  enum class Kind : std::uint8_t { arc, curve, reversed_curve };
  Kind kind;
  Index number;  ///< of the arc or the curve
};

struct CreaseNetwork {
  std::vector<Vec3> corners = {};
  std::vector<CreaseCurve> curves = {};
  /// The border of each sheet, in order: parts of the rim and curves.
  std::vector<std::vector<SheetSide>> sheets = {};
  /// The reason why the creases cannot be continued, without a full stop; empty if they can.
  std::string flaw = {};
};

/// Joins the ends so that no two curves cross. Two ends are joined by one curve; three and more
/// meet in a corner; four and more may meet in two corners that a straight crease joins. Of all
/// these, the network is chosen that continues the directions and curvatures of the ends best. An
/// end that fits no other is not continued, and is removed from `rim`. The result has a flaw if no
/// crease is left, or if there are more than eight ends. Corners lie nearest to the continued
/// creases and to the planes of flat sheets, and not farther from `middle` than `reach`. The curves
/// have points at distances of about `spacing`. Where creases run along the rim only, the whole
/// hole is one sheet.
CreaseNetwork continue_creases(CreasedRim& rim, const Vec3& middle, double reach, double spacing);

}  // namespace ibmfair
