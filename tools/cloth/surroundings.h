// The external forces on a sheet.
#pragma once

#include <optional>

#include "cloth/plate.h"
#include "cloth/sphere_contact.h"

namespace ibmfair::cloth {

struct Surroundings {
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
  Vec3 wind{0, 0, 0};         ///< m/s, the same everywhere and always ([W07] section 3.1)
  double drag = 0;            ///< kg/(m^2 s): of a triangle across the wind, >= 0
  std::optional<Sphere> sphere;
};

/// Sets F (#V x 3, newtons) to gravity and wind. The wind's force on a triangle is drag * area
/// times the part along its normal of the wind's velocity relative to it, a third of it on each
/// corner; linear in the velocity because [W07] has it so.
void external_forces(const Plate& plate, const Surroundings& surroundings, const Points& X,
                     const Points& V, Points& F);

}  // namespace ibmfair::cloth
