// Which triangle every pixel of a picture shows: a z-buffer without colours.
#pragma once

#include <cstddef>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"

namespace ibmfair {

/// For each pixel, row by row from the top left, the triangle that is visible at its centre.
struct Visibility {
  static constexpr Index nothing = -1;

  int width = 0;
  int height = 0;
  std::vector<Index> triangle;  ///< the frontmost triangle, or `nothing`
  std::vector<float> nearness;  ///< as in `Projected`; lowest() if there is no triangle

  std::size_t pixel(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Draws the triangles `F` with vertices `X` as seen by `camera`, both sides alike. Triangles with
/// a coordinate that is not finite, and triangles without area in the picture, are not drawn. If
/// two triangles are at the same place, the one listed first is visible.
Visibility find_visible(const Points& X, const Triangles& F, const Camera& camera, int width,
                        int height);

}  // namespace ibmfair
