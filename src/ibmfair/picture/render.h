// Pictures of meshes, rendered without a display or a graphics card. Shading is flat, because
// facets show ripples and noise that smooth shading would hide.
#pragma once

#include <span>

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"
#include "ibmfair/picture/foreground.h"
#include "ibmfair/picture/image.h"
#include "ibmfair/picture/shading.h"

namespace ibmfair {

struct RenderOptions {
  int width = 800;   ///< pixels, 1 .. 8192
  int height = 800;  ///< pixels, 1 .. 8192
  int samples = 3;   ///< per pixel and direction, 1 .. 4, averaged in linear light
  View view = {};
  Frame frame = {};
  Rgb background{255, 255, 255};
  bool silhouettes = true;  ///< dark lines where the surface ends or one part occludes another

  /// @throws BadOption for a value out of range.
  void validate() const;
};

/// The mesh that a picture shows: triangles `F` (#F x 3, any orientation) with vertices `X` (#V x
/// 3).
struct PaintedMesh {
  const Points& X;
  const Triangles& F;
  Paint paint = {};
};

/// A picture of `mesh`, seen from `options.view` and scaled to fill the picture. Triangles with a
/// coordinate that is not finite are left out; without triangles, the picture is plain background.
/// Equal inputs give equal pixels.
Image render(const PaintedMesh& mesh, const RenderOptions& options = {});

/// Pictures from left to right, rendered with one camera that sees all meshes, so that their sizes
/// can be compared. Front and back have the same colours in all of them: the front is the side that
/// most of the last picture shows. `options.width` is the width of each picture, and
/// `options.height` the largest height: rows that are empty in all pictures are cut off, except for
/// the view's margin.
Image render_side_by_side(std::span<const PaintedMesh> meshes, const RenderOptions& options = {});

}  // namespace ibmfair
