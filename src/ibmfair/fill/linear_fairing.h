// Linear fairing of a patch: the minimum of the quadratic form that the bending energy becomes when
// lengths and angles are those of the flat patch.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// Moves the patch's own vertices to the solution of S X = 0, where S is the Hessian of the
/// Lagrange member at the present positions ([W07] section 2.3) and all other vertices are fixed.
/// This is one linear system: the result always exists, and does not continue curvature as exactly
/// as the stationary surface does. Throws FactorizationFailed, OutOfMemory.
void fair_linearly(Patch& patch);

}  // namespace ibmfair
