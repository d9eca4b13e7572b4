// The nonlinear hinge of discrete shells (Grinspun, Hirani, Desbrun, Schroeder 2003), as [W07]
// compares with it in sections 2.4 and 3.1:
//
//   E = k sum over the hinges of 3 |e|^2 / (2 A) (phi - phi_rest)^2
//
// with phi the angle by which it is bent, and the length |e| of its edge and the area A of its two
// triangles at rest. Near a flat rest state it agrees with k times [W07]'s E_CR up to second order
// (Theorem 2). Exact gradient and Hessian.
#pragma once

#include <memory>

#include "cloth/energy_term.h"
#include "cloth/plate.h"

namespace ibmfair::cloth {

std::unique_ptr<EnergyTerm> bind_hinge_bending(const Plate& plate, const BlockHessian& H);

}  // namespace ibmfair::cloth
