// The table of bending models.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "cloth/energy_term.h"
#include "cloth/plate.h"

namespace ibmfair::cloth {

struct BendingForce {
  std::string_view name;     ///< name on the command line
  std::string_view summary;  ///< one line
  std::unique_ptr<EnergyTerm> (*create)(const Plate& plate, const BlockHessian& H);
};

std::span<const BendingForce> bending_forces();

/// The model with that name; throws BadOption, whose message lists all names.
const BendingForce& bending_force(std::string_view name);

}  // namespace ibmfair::cloth
