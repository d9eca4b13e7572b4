// The lighting of a picture: the colour of each visible triangle.
#pragma once

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
};

/// Flat shading, #F, with a strong light from the upper left and a weak light from the viewer, both
/// far away. Triangles that are not visible in `seen` stay dark.
std::vector<Light> shade_triangles(const Points& X, const Triangles& F, const Camera& camera,
                                   const Visibility& seen, const Paint& paint);

}  // namespace ibmfair
