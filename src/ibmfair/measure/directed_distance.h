// The distance from one surface to another.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"
#include "ibmfair/measure/normal_angles.h"

namespace ibmfair {

/// From a surface A to a surface B; the other way round it is another distance.
struct DirectedDistance {
  double mean = 0.0;             ///< over the area of A, length
  double rms = 0.0;              ///< over the area of A, length
  double max = 0.0;              ///< over samples and vertices: a lower bound of the true one
  Vec3 farthest = Vec3::Zero();  ///< the point of A where that is
  NormalAngles angles;           ///< between the normal at a sample and that at the point closest
                                 ///< to it
};

constexpr std::int64_t default_samples = 100'000;

/// From the triangles FA over XA to the triangles FB over XB. `samples` points are spread over A:
/// its area is cut into so many equal pieces, and each gets a point at random, the same in every
/// run. The vertices of A's triangles count for the maximum only. Throws BadMesh where either
/// surface has no area, BadOption for fewer than one sample.
DirectedDistance directed_distance(const Points& XA, const Triangles& FA, const Points& XB,
                                   const Triangles& FB, std::int64_t samples = default_samples);

}  // namespace ibmfair
