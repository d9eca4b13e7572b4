// Moves vertices within the surface toward even spacing. Noise displaces vertices tangentially,
// too, which a curvature energy hardly sees.
#pragma once

#include "ibmfair/energy/hessian.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Relaxes unknown interior vertices; those on a cut without orientation have no normal to project
/// with and stay.
class TangentialRelaxation {
 public:
  /// Refers to all three; `rings` are those of vertex_rings.
  TangentialRelaxation(const Topology& topology, const Rows& rings, const Unknowns& unknowns);

  /// The moves of one sweep at `X` (one row per unknown, length): half way to the mean of the
  /// neighbours, projected off the area-weighted vertex normal.
  void moves(const Points& X, Points& move) const;

 private:
  const Topology& topology_;
  const Rows& rings_;
  const Unknowns& unknowns_;
};

}  // namespace ibmfair
