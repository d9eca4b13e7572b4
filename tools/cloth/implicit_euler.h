// Implicit Euler as a minimisation: x' is where
//
//   Phi(x) = |x - x_k - h v_k|^2_M / (2 h^2) + alpha_1 |x - x_k|^2_M / (2 h) - <f, x> + E(x) + D(x)
//
// has its least value, with the external forces f at the start of the step and the dissipation D of
// cloth/energy_term.h; v' = (x' - x_k) / h. Newton's method starts at x_k ([W07] equation (12)).
#pragma once

#include <memory>

#include "cloth/integrators.h"

namespace ibmfair::cloth {

/// The default time step is 1/100 s.
std::unique_ptr<Integrator> bind_implicit_euler(const Plate& plate,
                                                const Surroundings& surroundings,
                                                const BendingForce& bending,
                                                const StepOptions& options);

}  // namespace ibmfair::cloth
