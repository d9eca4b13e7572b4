// The fairing of a polyline along itself: the counterpart, for a curve, of the flow of a surface.
//
//   dx/dt = -x_ssss,   in n steps of backward Euler:   (D + T/n S) x_{k+1} = D x_k
//
// s is the arc length of the polyline at the start. S = L^T M^-1 L with L the stiffness matrix of
// linear finite elements over s (the sum of the unit vectors towards both neighbours) and M the
// lumped lengths; D is M. Both are constant, so that the system is factored once and solved for
// the three coordinates. A ripple of wave number k on a straight line shrinks as one on a flat
// sheet does, by exp(-T k^4), with T = (cutoff / 2 pi)^4.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// What happens at the ends of a polyline. Both ends of an open polyline keep their positions.
enum class CurveEnds : std::uint8_t {
  closed,   ///< the last point is followed by the first
  natural,  ///< an open polyline that may turn about its ends
  clamped,  ///< an open polyline whose first and last edge stay
};

struct CurveFlowOptions {
  double cutoff = 0;  ///< wavelength that shrinks to 1/e, length; positive
  int steps = 8;      ///< backward Euler steps; at least 1
  int twicing = 0;    ///< how often the removed part is smoothed as well, and added back
  /// A factor of the cut-off for each point, #P, or empty for 1 everywhere; points with the factor
  /// 0 keep their positions in every bit.
  Eigen::VectorXd cutoff_factor = {};
};

/// The positions of the points `X` (#P x 3, in the order of the polyline) after the flow. Straight
/// lines stay, however unevenly they are divided. Of a closed polyline, the part that is an ellipse
/// (the mean and the first Fourier mode over s) stays, so that a loop that is shorter than the
/// cut-off becomes a round loop of its size instead of a point. The result does not depend on
/// position, rotation and scale, and reversing the order of the points reverses that of the result.
/// Polylines that have no length stay as they are. Throws BadOption if an option cannot be used.
Points curve_flow(const Points& X, CurveEnds ends, const CurveFlowOptions& options);

}  // namespace ibmfair
