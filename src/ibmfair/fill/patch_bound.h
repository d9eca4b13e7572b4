// How far a patch may reach: a bound that follows from the rim of its hole and from the normals of
// the mesh around it. A patch of stationary bending energy can run away: the energy does not change
// if the surface is scaled, and large triangles hide a part of it, so that a balloon may have less
// energy than the patch that continues the surface.
#pragma once

#include <limits>
#include <optional>

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// The sphere that has the normals of the mesh along the rim, and the direction from its centre to
/// the middle of the part that is missing.
struct RimSphere {
  Vec3 center = Vec3::Zero();
  double radius = 0;         ///< length
  Vec3 axis = Vec3::Zero();  ///< unit vector
  double height = 0;         ///< of `center` above the middle of the rim along `axis`, length
  double deviation = 0;      ///< root mean square distance of the rim from the sphere / radius

  /// Whether more than a half sphere is missing, and the rim and its normals say so clearly.
  bool is_deep() const;

  /// The area of the missing part, length^2.
  double missing_area() const;
};

/// Fits a sphere to the triangles along the rim. A narrow band of any surface of revolution fits:
/// the sphere then touches the band along the rim. None if the normals hardly change along the rim,
/// or if the rim spans no area.
std::optional<RimSphere> fit_rim_sphere(const Patch& patch);

/// The largest patch that counts as a continuation of the surface.
struct PatchBound {
  Vec3 center = Vec3::Zero();  ///< the middle of the rim
  /// The largest distance of a vertex from `center`, length.
  double reach = std::numeric_limits<double>::infinity();
  double area = std::numeric_limits<double>::infinity();  ///< length^2

  /// Whether a row of X from number `first` on lies too far away; also if it is not finite.
  bool is_exceeded(const Points& X, Index first) const;
};

/// The bound for a patch that has been triangulated, but not refined: a multiple of the size of the
/// rim, or of the sphere that fits the rim where more than a half sphere is missing.
PatchBound bound_of(const Patch& patch);

/// The area of the triangles of the patch.
double patch_area(const Patch& patch);

/// Replaces a patch that lies across the rim by one on the sphere: the vertices of the patch's own
/// are projected from the point of the sphere that is opposite to the missing part. Returns false,
/// without a change, if a vertex does not lie in front of that point.
bool lift_to(const RimSphere& sphere, Patch& patch);

}  // namespace ibmfair
