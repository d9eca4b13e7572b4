// Symplectic Euler: v' = v + h f(x, v) / m, x' = x + h v'. [W07] has plain Euler (x' = x + h v),
// which costs the same, but gains energy in every step of any length.
#pragma once

#include <memory>

#include "cloth/integrators.h"

namespace ibmfair::cloth {

/// Half of the longest stable step for small oscillations of the sheet at rest, seconds:
/// h^2 w^2 + 2 h alpha_2 w^2 < 4 with w the highest angular frequency.
double stable_time_step(const Plate& plate, ElasticSheet& sheet);

std::unique_ptr<Integrator> bind_explicit_euler(const Plate& plate,
                                                const Surroundings& surroundings,
                                                const BendingForce& bending,
                                                const StepOptions& options);

}  // namespace ibmfair::cloth
