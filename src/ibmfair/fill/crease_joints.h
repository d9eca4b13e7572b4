// How well creases that end at the rim of a hole can be joined, and where they meet.
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ibmfair/fill/rim_creases.h"

namespace ibmfair {

/// A way to join some ends: two ends by one curve, or several in one corner or in two. A single end
/// is not continued.
struct CreaseJoint {
  std::vector<Index> ends;    ///< in the order of the rim, beginning with those of the first corner
  std::vector<Vec3> corners;  ///< none: one curve joins two ends
  std::size_t at_first = 0;   ///< the number of ends that meet in the first corner
  /// Small if the curves continue the ends; infinite if the ends cannot be joined in this way.
  double cost = std::numeric_limits<double>::infinity();
};

class JointChoice {
 public:
  /// The rim must outlive this object. Corners lie within `reach` of `middle`.
  JointChoice(const CreasedRim& rim, Vec3 middle, double reach)
      : rim_(rim), middle_(std::move(middle)), reach_(reach) {}

  /// The joint of least cost for these ends, which are in the order of the rim.
  CreaseJoint best(const std::vector<Index>& ends) const;

 private:
  struct Corner {
    Vec3 position;
    double cost;
  };

  double curve_cost(Index i, Index j) const;
  std::optional<Corner> corner(const std::vector<Index>& ends) const;
  std::optional<Corner> corner(const std::vector<Index>& ends, bool curved) const;
  std::optional<Vec3> meeting_point(const std::vector<Index>& ends,
                                    const std::vector<CurvePoint>& lines) const;
  double link_cost(const Vec3& from, const Vec3& to, Index arc, Index other_arc) const;
  Index arc_before(Index end) const;

  const CreasedRim& rim_;
  const Vec3 middle_;
  const double reach_;
};

}  // namespace ibmfair
