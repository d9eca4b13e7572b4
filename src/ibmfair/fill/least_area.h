// The patch of least area: a minimal surface, such as a soap film spans.
// U. Pinkall, K. Polthier: Computing discrete minimal surfaces and their conjugates, Experimental
// Mathematics 2 (1993), section 3.
#pragma once

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// Moves the patch's own vertices to a stationary point of its area and adapts its triangulation;
/// all other vertices are fixed. A patch with a planar rim becomes flat. Returns whether the area
/// settled; it does not where no minimal surface spans the rim, such as two circles too far apart.
/// Throws FactorizationFailed, OutOfMemory.
bool span_least_area(Patch& patch);

}  // namespace ibmfair
