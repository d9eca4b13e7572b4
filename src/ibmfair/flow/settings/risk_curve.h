// Risks of smoothing to different cut-offs, and the cut-off with the least.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace ibmfair {

/// What one cut-off is expected to leave of the distance to the true shape along the normals: its
/// mean square, and the mean square of its difference between neighbours, scaled so that both are
/// the variance of the noise where all of it is left. They may be negative by chance if the true
/// values are close to 0.
struct CutoffTrial {
  double cutoff = 0;        ///< length
  double risk = 0;          ///< length^2
  double slope_risk = 0;    ///< length^2
  double slope_weight = 0;  ///< ratio; of `slope_risk` beside `risk` in the choice of a cut-off

  /// What the choice of a cut-off makes least, length^2.
  double total() const { return slope_weight == 0 ? risk : risk + slope_weight * slope_risk; }
};

/// The position of the trial with the least risk, the first of several. Precondition: there are
/// trials.
std::size_t least_risk(const std::vector<CutoffTrial>& trials);

/// The cut-off (length) at the minimum of the parabola through the least risk and its two
/// neighbours, over the logarithm of the cut-off. If creases are kept, the risk rises more steeply
/// when creases disappear than it fell before; so the cut-off is then not shortened by the
/// parabola. `trials`: with increasing cut-offs, each longer than the last by the same factor.
double cutoff_of_least_risk(const std::vector<CutoffTrial>& trials, bool keeps_creases);

struct CutoffRange {
  double start = 0;     ///< the first cut-off, length
  double shortest = 0;  ///< length
  double largest = 0;   ///< length
  /// If the first cut-off leaves a larger risk (length^2), only the shortest one is tried.
  double hopeless = std::numeric_limits<double>::infinity();
  /// Risks that differ by at most this (length^2) count as equal: after one that gains no more,
  /// longer cut-offs are not tried; and of the first two, if the second one does not leave more,
  /// the first one is left out, because the longer one leaves smoother faces.
  double tolerance = 0;
};

/// The trials at the first cut-off of the range and at cut-offs around it, each longer than the
/// last by the square root of two, until the least risk has a neighbour on both sides or the range
/// ends; or, if the first one is hopeless, that and the shortest one.
std::vector<CutoffTrial> trials_around(const std::function<CutoffTrial(double cutoff)>& trial,
                                       const CutoffRange& range);

}  // namespace ibmfair
