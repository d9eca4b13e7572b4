// A hole filling problem with six sides: [W07] Figure 8, right, after Bobenko and Schroeder,
// "Discrete Willmore Flow", SGP 2005.
#pragma once

#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// A hexagonal piece, with 24 * 4^subdivide triangles, of a smooth Loop surface whose six corners
/// are alternately high and low. The two outer rings of vertices lie on the surface and prescribe
/// positions and normals. All other vertices lie on six flat triangles between the corners and
/// their mean; they are a trivial filling as a starting point. Throws BadOption for subdivide < 1
/// or for more than `largest_shape` faces.
TriangleMesh make_six_sided_hole(int subdivide);

}  // namespace ibmfair
