// Surfaces that are known exactly and with which meshes can be compared.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A closed surface given by its signed distance.
class ExactSurface {
 public:
  ExactSurface() = default;
  ExactSurface(const ExactSurface&) = delete;
  ExactSurface& operator=(const ExactSurface&) = delete;
  virtual ~ExactSurface() = default;

  /// The distance from x to the surface, negative inside.
  virtual double signed_distance(const Vec3& x) const = 0;

  /// The outward unit normal at the surface point closest to x; if there are several closest
  /// points, at any one of them.
  virtual Vec3 normal(const Vec3& x) const = 0;
};

/// A sphere. Throws BadOption for a radius that is not positive.
class ExactSphere : public ExactSurface {
 public:
  ExactSphere(Vec3 center, double radius);
  double signed_distance(const Vec3& x) const override;
  Vec3 normal(const Vec3& x) const override;

 private:
  Vec3 center_;
  double radius_;
};

/// The torus about the axis through `center` parallel to z. `axis_radius` is the distance from the
/// axis to the middle of the tube, and `tube_radius` is the radius of the tube. Throws BadOption
/// unless axis_radius > tube_radius > 0.
class ExactTorus : public ExactSurface {
 public:
  ExactTorus(Vec3 center, double axis_radius, double tube_radius);
  double signed_distance(const Vec3& x) const override;
  Vec3 normal(const Vec3& x) const override;

 private:
  Vec3 from_tube_middle(const Vec3& x) const;

  Vec3 center_;
  double axis_radius_;
  double tube_radius_;
};

}  // namespace ibmfair
