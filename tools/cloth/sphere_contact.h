// Contact of the vertices with a fixed sphere, with Coulomb friction. Contact of edges and
// triangles with the sphere and of the sheet with itself is ignored.
#pragma once

#include <memory>

#include "cloth/energy_term.h"
#include "cloth/plate.h"

namespace ibmfair::cloth {

struct Sphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0.3;       ///< metres
  double clearance = 0.004;  ///< metres: the sheet rests at this distance outside of the sphere
  double friction = 0.3;     ///< Coulomb's coefficient, >= 0

  double resting_radius() const { return radius + clearance; }
};

/// Contact for time steps of h seconds whose Hessian is used: a spring that pushes out what is
/// below the resting radius, so stiff that a vertex sinks in by 1 % of what it would fall in one
/// step for each of its weights that it carries, and friction in proportion to the spring's force
/// at the start of the step, against the displacement since. Its `beta` is not used.
std::unique_ptr<EnergyTerm> bind_contact(const Sphere& sphere, const Plate& plate, double h,
                                         const BlockHessian& H);

/// Puts the free vertices that are nearer to the centre than `radius` at that distance, takes away
/// their inward velocity, and reduces the tangential velocity by the friction of that impulse.
void push_out(const Sphere& sphere, double radius, const Plate& plate, Points& X, Points& V);

}  // namespace ibmfair::cloth
