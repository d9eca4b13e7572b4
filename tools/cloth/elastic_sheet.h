// The elastic energy of a plate, E_p + E_b ([W07] section 3.1), and its Hessian's pattern.
#pragma once

#include <memory>

#include "cloth/bending_forces.h"
#include "cloth/membrane.h"

namespace ibmfair::cloth {

struct ElasticSheet {
  BlockHessian hessian;
  std::unique_ptr<EnergyTerm> membrane;
  std::unique_ptr<EnergyTerm> bending;

  ElasticSheet(const Plate& plate, const BendingForce& force)
      : hessian(element_rows(plate.topology), static_cast<Index>(plate.rest.rows())),
        membrane(bind_membrane(plate, hessian)),
        bending(force.create(plate, hessian)) {}
};

}  // namespace ibmfair::cloth
