// Risks of smoothing to different cut-offs, and the cut-off with the least.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace ibmfair {

/// What one cut-off is expected to leave: the mean squared distance to the true shape, along the
/// normals.
struct CutoffTrial {
  double cutoff = 0;  ///< length
  double risk = 0;    ///< length^2; may be negative by chance if the true risk is close to 0
};

/// The position of the trial with the least risk, the first of several. Precondition: there are
/// trials.
std::size_t least_risk(const std::vector<CutoffTrial>& trials);

/// The cut-off (length) at the minimum of the parabola through the least risk and its two
/// neighbours, over the logarithm of the cut-off. If creases are kept, the risk rises more steeply
/// when creases disappear than it fell before; so the cut-off is then shortened by only a part of
/// that shift. `trials`: with increasing cut-offs, each longer than the last by the same factor.
double cutoff_of_least_risk(const std::vector<CutoffTrial>& trials, bool keeps_creases);

/// The trials at `start` (length) and at cut-offs around it, each longer than the last by the
/// square root of two, until the least risk has a neighbour on both sides or the next cut-off would
/// be below `shortest` or above `largest`.
std::vector<CutoffTrial> trials_around(const std::function<double(double cutoff)>& risk,
                                       double start, double shortest, double largest);

}  // namespace ibmfair
