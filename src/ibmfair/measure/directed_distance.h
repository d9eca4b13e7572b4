// The distance from one surface to another.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"
#include "ibmfair/measure/normal_angles.h"

namespace ibmfair {

/// The distance from a surface A to a surface B. It is not symmetric in A and B.
struct DirectedDistance {
  double mean = 0.0;             ///< over the area of A, length
  double rms = 0.0;              ///< over the area of A, length
  double max = 0.0;              ///< over samples and vertices: a lower bound of the true maximum
  Vec3 farthest = Vec3::Zero();  ///< the point of A with the distance `max`
  /// Between the normals at a sample and at the point of B closest to the sample.
  NormalAngles angles;
};

constexpr std::int64_t default_samples = 100'000;

/// The distance from the triangles FA with vertices XA to the triangles FB with vertices XB. The
/// area of A is divided into `samples` pieces of equal area, and one random point is taken in each
/// piece; every run takes the same points. The vertices of A's triangles count for the maximum
/// only. Throws BadMesh if either surface has no area, BadOption for fewer than one sample.
DirectedDistance directed_distance(const Points& XA, const Triangles& FA, const Points& XB,
                                   const Triangles& FB, std::int64_t samples = default_samples);

}  // namespace ibmfair
