// Pictures of meshes without a display or a graphics card: flat shading, because facets show
// ripples and noise that smooth shading would hide.
#pragma once

#include <span>

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"
#include "ibmfair/picture/image.h"
#include "ibmfair/picture/shading.h"

namespace ibmfair {

struct RenderOptions {
  int width = 800;   ///< pixels, 1 .. 8192
  int height = 800;  ///< pixels, 1 .. 8192
  int samples = 3;   ///< per pixel and direction, 1 .. 4, averaged in linear light
  View view = {};
  Rgb background{255, 255, 255};
  bool silhouettes = true;  ///< dark lines where the surface ends or one part hides another

  /// @throws BadOption for a value out of range.
  void validate() const;
};

/// What a picture shows: triangles `F` (#F x 3, any orientation) over `X` (#V x 3).
struct PaintedMesh {
  const Points& X;
  const Triangles& F;
  Paint paint = {};
};

/// A picture of `mesh`, seen from `options.view` and filling the picture. Triangles with a
/// coordinate that is not finite are left out; no triangles give the plain background. The same
/// input always gives the same pixels.
/// @throws BadOption as RenderOptions::validate does, and when paint.triangle is of another size.
Image render(const PaintedMesh& mesh, const RenderOptions& options = {});

/// Pictures from left to right, taken by one camera that sees all of them: what is larger in the
/// picture is larger. `options.width` is the width of each, `options.height` the largest height:
/// rows that stay empty in all are cut off down to the view's margin.
/// @throws BadOption as `render` does.
Image render_side_by_side(std::span<const PaintedMesh> meshes, const RenderOptions& options = {});

}  // namespace ibmfair
