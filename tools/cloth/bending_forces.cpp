#include "cloth/bending_forces.h"

#include <array>

#include "cloth/hinge_bending.h"
#include "cloth/isometric_bending.h"
#include "ibmfair/base/named_row.h"

namespace ibmfair::cloth {
namespace {

constexpr std::array bending_table{
    BendingForce{"hinge", "nonlinear hinge of discrete shells", bind_hinge_bending},
    BendingForce{"ibm", "isometric bending model, its Hessian precomputed", bind_isometric_bending},
};

}  // namespace

std::span<const BendingForce> bending_forces() {
  return bending_table;
}

const BendingForce& bending_force(std::string_view name) {
  return row_named(bending_forces(), "bending model", name);
}

}  // namespace ibmfair::cloth
