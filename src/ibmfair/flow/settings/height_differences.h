// How steeply heights over a surface change: their differences between neighbours.
#pragma once

#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

inline double mean_square(const Eigen::VectorXd& values) {
  return values.squaredNorm() / static_cast<double>(values.size());
}

class HeightDifferences {
 public:
  /// Between the listed unknowns that an edge joins.
  HeightDifferences(const std::vector<Index>& counted, const Unknowns& unknowns,
                    const Topology& topology);

  /// The differences over the root of two, so that those of independent heights have the mean
  /// square of the heights; one row per pair. `heights`: one row per listed unknown.
  template <class Heights>
  typename Heights::PlainObject operator()(const Heights& heights) const {
    return std::numbers::sqrt2 / 2 *
           (heights(neighbours_.col(0), Eigen::all) - heights(neighbours_.col(1), Eigen::all));
  }

 private:
  Edges neighbours_;  // pairs of positions in the list
};

}  // namespace ibmfair
