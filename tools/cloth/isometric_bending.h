// [W07]'s isometric bending model with Crouzeix-Raviart elements: E = k/2 tr(X^T S X), whose
// Hessian k S is computed once, from the state at rest (section 3.1). The strains are the mean
// curvature vectors, linear in X; they turn with the sheet, and so do the forces, but damping by
// their rates brakes the rotation of a bent sheet.
#pragma once

#include <memory>

#include "cloth/energy_term.h"
#include "cloth/plate.h"

namespace ibmfair::cloth {

/// The state at rest must be flat, or the plate is bent when it is at rest.
std::unique_ptr<EnergyTerm> bind_isometric_bending(const Plate& plate, const BlockHessian& H);

}  // namespace ibmfair::cloth
