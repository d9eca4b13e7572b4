// The lighting of a picture: the colour of each visible triangle.
#pragma once

#include <limits>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"
#include "ibmfair/picture/image.h"
#include "ibmfair/picture/visibility.h"

namespace ibmfair {

/// Red, green and blue in linear light: proportional to the light that a screen emits, so that
/// means are correct. The numbers of an Rgb are not. 1 is white.
using Light = Eigen::Array3f;

/// Conversions from sRGB and back (IEC 61966-2-1); light beyond white is clipped.
Light light_of(Rgb colour);
Rgb colour_of(const Light& light);

/// The colours of triangles before lighting.
struct Paint {
  Rgb front{214, 210, 200};        ///< the side that most of the visible triangles show
  Rgb back{190, 120, 90};          ///< the other side: seen through holes, or of flipped triangles
  std::vector<Rgb> triangle = {};  ///< #F, instead of `front` and `back`, or empty
  /// Triangles from this number on have the colour `marked` on both sides.
  Eigen::Index marked_from = std::numeric_limits<Eigen::Index>::max();
  Rgb marked{240, 190, 120};
};

/// Whether most of the visible pixels show the side of their triangle from which its corners run
/// anticlockwise; also if nothing is visible.
bool shows_anticlockwise_sides(const Points& X, const Triangles& F, const Camera& camera,
                               const Visibility& seen);

/// Flat shading, #F, with a strong light from the upper left and a weak light from the viewer, both
/// far away. `front_is_anticlockwise`: the colour `front` is for the side from which the corners of
/// a triangle run anticlockwise. Triangles that are not visible in `seen` stay dark.
std::vector<Light> shade_triangles(const Points& X, const Triangles& F, const Camera& camera,
                                   const Visibility& seen, const Paint& paint,
                                   bool front_is_anticlockwise);

}  // namespace ibmfair
