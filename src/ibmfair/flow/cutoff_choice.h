// The cut-off that takes the most noise and the least of the shape, out of the noisy mesh alone:
// that of the least risk among some (flow/cutoff_trials.h).
//
// The noise must be independent from vertex to vertex: of the steps between the slices of a
// scanner, say, nothing is seen here.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ibmfair/flow/cutoff_trials.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct CutoffChoice {
  double cutoff = 0;                ///< length
  double noise = 0;                 ///< standard deviation along the normals, length
  std::vector<CutoffTrial> trials;  ///< with increasing cut-off

  const CutoffTrial& best() const;  ///< that of the least risk
};

/// Told before each trial.
using TrialObserver = std::function<void(double cutoff)>;

struct CutoffSearch {
  double largest = 0;         ///< cut-off that is tried, length
  double shortest_edges = 2;  ///< that is tried, in mean edge lengths
  TrialObserver observer = {};
  double noise = 0;       ///< as in CutoffChoice; 0: told by the mesh
  Index enough = 50'000;  ///< vertices: where many more move, a sample of so many tells all
};

/// Lets a copy of `X` flow as `options` say, whose total time is not looked at, through cut-offs
/// from the shortest on, each longer by the square root of two, up to the largest or until the risk
/// has clearly risen or hardly changes; the choice is between those around the least. Volume and
/// area are not kept. Deterministic. Throws what the flow throws, and BadMesh where no vertex
/// moves.
CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options,
                           const CutoffSearch& search);

}  // namespace ibmfair
