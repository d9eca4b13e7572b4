// The cut-off that takes the most noise and the least of the shape, out of the noisy mesh alone.
//
// Of a smoother F that is nearly linear in the heights of the vertices over the surface, the mean
// squared distance of what it makes of y = x + noise to x is, in expectation,
//
//   risk = |y - F y|^2 / n + 2 s^2 tr F / n - s^2
//
// s the noise's standard deviation: C. Stein, "Estimation of the mean of a multivariate normal
// distribution", Annals of Statistics 9 (1981). No term needs x. As F is known only by what it
// does, tr F is z^T F z on the mean over random z (S. Ramani, T. Blu, M. Unser, "Monte-Carlo SURE",
// IEEE Transactions on Image Processing 17, 2008), where F is the linearised flow at its end; and s
// is how far the flow with a short cut-off moves the vertices, over how far it moves white noise.
// The trials are one flow that passes the cut-offs one after the other: of a cut-off's time, three
// quarters lie behind the one before.
//
// The noise must be independent from vertex to vertex: of the steps between the slices of a
// scanner, say, nothing is seen here.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct CutoffTrial {
  double cutoff = 0;  ///< length
  double risk = 0;    ///< length^2; below 0 by chance where next to nothing is left
};

struct CutoffChoice {
  double cutoff = 0;                ///< length
  double noise = 0;                 ///< standard deviation along the normals, length
  std::vector<CutoffTrial> trials;  ///< with increasing cut-off
};

/// Told before each trial.
using TrialObserver = std::function<void(double cutoff)>;

/// Lets a copy of `X` flow as `options` say, whose total time is not looked at, through cut-offs
/// from twice the mean edge length on, each longer by the square root of two, up to `largest` or
/// until the risk has clearly risen or hardly changes; the choice is between those around the
/// least. Where many more than `enough` vertices move, a sample of so many of them tells all.
/// Volume and area are not kept. Deterministic. Throws what the flow throws, and BadMesh where no
/// vertex moves.
CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options,
                           double largest, const TrialObserver& observer = {},
                           Index enough = 50'000);

}  // namespace ibmfair
