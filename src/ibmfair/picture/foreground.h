// What lies between a part of a scene and the viewer.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"

namespace ibmfair {

/// The points that a picture is scaled to if it does not show a whole mesh.
struct Frame {
  Points X = {};  ///< #P x 3, finite; empty: the picture shows the whole mesh
  /// Triangles that reach further in front of the points than this are left out; in diagonals of
  /// the bounding box of the points, 0 .. 1.
  double foreground = 0.5;
};

/// The triangles `F` (#F x 3); those left out have one vertex as all their corners.
Triangles without_foreground(const Points& X, const Triangles& F, const View& view,
                             const Frame& frame);

}  // namespace ibmfair
