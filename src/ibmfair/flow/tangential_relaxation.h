// Moves vertices within the surface toward even spacing. Noise displaces vertices tangentially,
// too, which a curvature energy hardly sees.
#pragma once

#include <vector>

#include "ibmfair/energy/hessian.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Relaxes unknown interior vertices; those on a cut without orientation have no normal to project
/// with and stay.
class TangentialRelaxation {
 public:
  TangentialRelaxation(const Topology& topology, const Unknowns& unknowns);

  /// The moves of one sweep at `X` (one row per unknown, length): half way to the mean of the
  /// neighbours, projected off the area-weighted vertex normal.
  void moves(const Points& X, Points& move) const;

 private:
  const Topology& topology_;
  std::vector<Index> vertex_;  // of each unknown, -1 where it is not relaxed
  Rows neighbours_;            // per unknown
};

}  // namespace ibmfair
