// Lets a patch continue the curvature of the mesh around its hole, not only the directions.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// Moves the patch's own vertices to where the mesh within four rings of the rim predicts them.
///
/// Positions are taken for the sum s + r of a smooth and a rough field on the surface. They
/// minimise, with the metric of the present patch and the wavelength w = 1.5 edges of the rim,
///
///   integral |grad Laplacian s|^2 + (2 pi / w)^4 integral |grad r|^2 + |r|^2 / l^2,  l = 10 edges,
///
/// subject to s + r = X at the vertices of the mesh. Without r, the result would be the least
/// variation of curvature, which takes the curvature from the roughness of three rings. For
/// Gaussian fields with these precisions, s + r is the best linear prediction (kriging, Cressie
/// 1993, section 3.4). The patch does not change if its surroundings have defects. Throws
/// FactorizationFailed if triangles without area make the metric useless, and OutOfMemory.
void continue_curvature(const Points& X, const Topology& topology, Patch& patch);

}  // namespace ibmfair
