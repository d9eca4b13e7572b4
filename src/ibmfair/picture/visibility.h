// Which triangle every pixel of a picture shows: a z-buffer without colours.
#pragma once

#include <cstddef>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/picture/camera.h"

namespace ibmfair {

/// Per pixel, row by row from the top left, what is seen at the pixel's centre.
struct Visibility {
  static constexpr Index nothing = -1;

  int width = 0;
  int height = 0;
  std::vector<Index> triangle;  ///< the frontmost triangle, or `nothing`
  std::vector<float> nearness;  ///< as in `Projected`; lowest() where there is nothing

  std::size_t pixel(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Draws the triangles `F` over `X` with `camera`, both sides alike. Triangles with a coordinate
/// that is not finite, and those without area in the picture, are not drawn. Of two triangles at
/// the same place the earlier one is seen.
Visibility find_visible(const Points& X, const Triangles& F, const Camera& camera, int width,
                        int height);

}  // namespace ibmfair
