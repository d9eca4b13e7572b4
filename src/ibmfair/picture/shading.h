// The lights of a picture: what colour each visible triangle has.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"
#include "ibmfair/picture/image.h"
#include "ibmfair/picture/visibility.h"

namespace ibmfair {

/// Red, green and blue in proportion to the light that a screen sends out, so that means are right;
/// the numbers of an Rgb are not. 1 is white.
using Light = Eigen::Array3f;

/// From sRGB and back (IEC 61966-2-1); what is beyond white is clipped.
Light light_of(Rgb colour);
Rgb colour_of(const Light& light);

/// What triangles are painted with before light falls on them.
struct Paint {
  Rgb front{214, 210, 200};        ///< the side that most of the visible triangles show
  Rgb back{190, 120, 90};          ///< the other side: seen through holes, or turned over
  std::vector<Rgb> triangle = {};  ///< #F, instead of front and back; or empty
};

/// Flat shading, #F: a strong light from the upper left and a weak one from the viewer, both far
/// away. Triangles that `seen` does not show stay dark.
std::vector<Light> shade_triangles(const Points& X, const Triangles& F, const Camera& camera,
                                   const Visibility& seen, const Paint& paint);

}  // namespace ibmfair
