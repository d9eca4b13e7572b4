// Where a picture is taken from.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The view: a direction, not a place, because the distance follows from what is to be seen.
struct View {
  Vec3 from{0.35, 0.3, 1.0};   ///< from the scene towards the viewer; any length but 0
  Vec3 up{0.0, 1.0, 0.0};      ///< what points upwards in the picture; any length
  double field_of_view = 0.4;  ///< of the shorter side, radians in [0, 2]; 0: orthographic
  double margin = 0.04;        ///< left free on every side, as a part of the shorter one

  /// @throws BadOption for a value out of range or not finite.
  void validate() const;
};

/// A point as a picture sees it: pixels from the top left corner, and a nearness that is larger in
/// front and linear in the picture along any straight line of the scene. Near the centre of the
/// scene its unit is a pixel too: as far in depth as a pixel is wide.
struct Projected {
  double column = 0.0;
  double row = 0.0;
  double nearness = 0.0;
};

/// The map from the scene to a picture of width x height pixels.
class Camera {
 public:
  /// Centred on `points` (#P x 3, finite), and as close as keeps all of them within the margins.
  /// @throws BadOption as View::validate does.
  Camera(const View& view, int width, int height, const Points& points);

  Projected project(const Vec3& x) const;

  /// From a point towards the viewer, of length 1.
  Vec3 towards_viewer(const Vec3& x) const;

  /// A direction given along the picture's axes: to the right, upwards, towards the viewer.
  Vec3 in_scene(const Vec3& direction) const;

 private:
  /// Coordinates along right, up and back, from the centre of what is seen.
  Vec3 in_view(const Vec3& x) const;
  void centre_on(const Points& points);
  void fit_orthographic(const Points& points);
  void fit_perspective(const Points& points);

  Vec3 right_, up_, back_;
  Vec3 centre_{0.0, 0.0, 0.0};
  double half_width_, half_height_;  // of the picture, pixels
  double usable_half_width_, usable_half_height_;
  double focal_length_ = 0.0;  // pixels; 0: orthographic
  double distance_ = 1.0;      // of the viewer from the centre, scene units
  double scale_ = 1.0;         // pixels per scene unit, orthographic only
};

}  // namespace ibmfair
