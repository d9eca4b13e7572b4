// Random triangulations of shapes: vertices are moved away from their places in a regular pattern,
// but stay on the surface. The same seed gives the same result on every platform.
#pragma once

#include <cstdint>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The size of the random displacements. Up to about 0.3 cells, no triangle of a regular pattern
/// turns over, and most edges remain Delaunay.
struct Jitter {
  double amount = 0;  ///< offsets are uniform in [-amount, amount]; in [0, 0.5)
  std::uint64_t seed = 1;
};

class RandomOffsets {
 public:
  /// Throws BadOption for an amount out of range.
  explicit RandomOffsets(const Jitter& jitter);

  double next() { return amount_ * (2 * random_.uniform() - 1); }

 private:
  double amount_;
  RandomNumbers random_;
};

/// Adds random offsets, in mean edge lengths, to the three coordinates of each vertex of a mesh on
/// the unit sphere, then projects the vertex back onto the sphere.
void jitter_on_unit_sphere(Points& X, const Triangles& F, const Jitter& jitter);

}  // namespace ibmfair
