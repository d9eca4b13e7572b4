// A hole filling problem with six sides: [W07] Figure 8, right, after Bobenko and Schroeder,
// "Discrete Willmore Flow", SGP 2005.
#pragma once

#include "ibmfair/shapes/subdivide.h"

namespace ibmfair {

/// A hexagonal piece of 24 * 4^subdivide triangles of a smooth Loop surface whose six corners stand
/// up and down in turn. Its two outer rings of vertices lie on the surface and prescribe positions
/// and normals; all others lie on six flat triangles between the corners and their mean: the
/// trivial filling to start from. Throws BadOption for subdivide < 1 or results above
/// `largest_shape` faces.
TriangleMesh make_six_sided_hole(int subdivide);

}  // namespace ibmfair
