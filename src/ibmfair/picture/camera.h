// The camera of a picture.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The view of a picture. It has a direction but no position, because the distance is chosen to fit
/// the scene.
struct View {
  Vec3 from{0.35, 0.3, 1.0};   ///< from the scene towards the viewer; any length but 0
  Vec3 up{0.0, 1.0, 0.0};      ///< the direction that points upwards in the picture; any length
  double field_of_view = 0.4;  ///< of the shorter side, radians in [0, 2]; 0: orthographic
  double margin = 0.04;        ///< free margin on every side, relative to the shorter side

  /// @throws BadOption for a value out of range or not finite.
  void validate() const;
};

/// A point in the picture: pixels from the top left corner, and a nearness, which is larger in
/// front and linear in the picture along any straight line of the scene. Near the centre of the
/// scene, one unit of nearness is the depth that equals the width of a pixel.
struct Projected {
  double column = 0.0;
  double row = 0.0;
  double nearness = 0.0;
};

/// The map from the scene to a picture of width x height pixels.
class Camera {
 public:
  /// A camera that is centred on `points` (#P x 3, finite) and as close as possible with all of
  /// them inside the margins.
  Camera(const View& view, int width, int height, const Points& points);

  Projected project(const Vec3& x) const;

  /// The unit vector from a point towards the viewer.
  Vec3 towards_viewer(const Vec3& x) const;

  /// The direction in the scene of a vector given in the picture's axes: right, up, towards the
  /// viewer.
  Vec3 in_scene(const Vec3& direction) const;

 private:
  /// Coordinates along right, up and back, relative to centre_.
  Vec3 in_view(const Vec3& x) const;
  void centre_on(const Points& points);
  void fit_orthographic(const Points& points);
  void fit_perspective(const Points& points);

  Vec3 right_, up_, back_;
  Vec3 centre_{0.0, 0.0, 0.0};
  double half_width_, half_height_;  // of the picture, pixels
  double usable_half_width_, usable_half_height_;
  double focal_length_ = 0.0;  // pixels; 0: orthographic
  double distance_ = 1.0;      // distance of the viewer from the centre, scene units
  double scale_ = 1.0;         // pixels per scene unit, orthographic only
};

}  // namespace ibmfair
