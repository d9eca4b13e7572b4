// Noise that neighbouring vertices have in common, as that of depth cameras and slices.
#pragma once

#include <cmath>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "support/states.h"

namespace ibmfair::test {

inline double edge_of(const State& state) {
  return mean_edge_length(state.X, state.topology.E);
}

/// Adds noise of this standard deviation (mean edge lengths) that is averaged over each vertex and
/// its neighbours `passes` times.
inline void add_correlated_noise(State& state, double deviation, int passes) {
  Points noise = Points::Zero(state.X.rows(), 3);
  add_noise(noise, 1, 3);
  const CompressedRows rings = vertex_rings(state.topology);
  for (int pass = 0; pass < passes; ++pass) {
    const Points last = noise;
    for (Index v = 0; v < rings.size(); ++v) {
      for (const Index neighbour : rings[v]) {
        noise.row(v) += last.row(neighbour);
      }
      noise.row(v) /= static_cast<double>(rings[v].size() + 1);
    }
  }
  const double rms = std::sqrt(noise.squaredNorm() / static_cast<double>(noise.size()));
  state.X += deviation * edge_of(state) / rms * noise;
}

/// Adds white noise and noise that is averaged twice, each of this standard deviation (mean edge
/// lengths).
inline void add_mixed_noise(State& state, double deviation) {
  const double edge = edge_of(state);
  add_correlated_noise(state, deviation, 2);
  add_noise(state.X, deviation * edge, 4);
}

}  // namespace ibmfair::test
