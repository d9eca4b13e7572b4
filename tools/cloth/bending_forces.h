// The table of bending models.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "cloth/energy_term.h"
#include "cloth/plate.h"

namespace ibmfair::cloth {

struct BendingForce {
  std::string_view name;     ///< as the command line takes it
  std::string_view summary;  ///< one line
  std::unique_ptr<EnergyTerm> (*bind)(const Plate& plate, const BlockHessian& H);
};

std::span<const BendingForce> bending_forces();

/// The model of that name; throws BadOption, naming those there are.
const BendingForce& bending_force(std::string_view name);

}  // namespace ibmfair::cloth
