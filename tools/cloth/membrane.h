// Resistance to stretching: linear triangles of constant strain and the St. Venant-Kirchhoff
// material in plane stress (Zienkiewicz, Taylor: "The Finite Element Method"). With F the
// deformation gradient of a triangle (3 x 2, constant on it) and eps = (F^T F - 1) / 2 Green's
// strain,
//
//   E = sum_t A_t (lambda / 2 (tr eps)^2 + mu eps : eps)
//   lambda = Y nu / (1 - nu^2),  mu = Y / (2 (1 + nu)),  Y = Young's modulus times thickness
//
// Invariant under rigid motions, exact gradient and Hessian.
#pragma once

#include <memory>

#include "cloth/energy_term.h"
#include "cloth/plate.h"

namespace ibmfair::cloth {

/// `H` provides the places of the Hessian's blocks.
std::unique_ptr<EnergyTerm> bind_membrane(const Plate& plate, const BlockHessian& H);

}  // namespace ibmfair::cloth
