#include "cloth/integrators.h"

#include <array>
#include <cmath>

#include "cloth/explicit_euler.h"
#include "cloth/implicit_euler.h"
#include "ibmfair/base/named_row.h"

namespace ibmfair::cloth {
namespace {

constexpr std::array integrator_table{
    IntegratorRow{"implicit", "implicit Euler, by Newton's method with a line search",
                  bind_implicit_euler},
    IntegratorRow{"explicit", "symplectic Euler, in steps that are stable", bind_explicit_euler},
};

}  // namespace

Motion at_rest(const Points& X) {
  return {X, Points::Zero(X.rows(), 3)};
}

std::span<const IntegratorRow> integrators() {
  return integrator_table;
}

const IntegratorRow& integrator(std::string_view name) {
  return row_named(integrators(), "integrator", name);
}

void advance(Integrator& integrator, double seconds, Motion& motion) {
  const auto steps = static_cast<long>(std::ceil(seconds / integrator.time_step() - 1e-9));
  for (long i = 0; i < steps; ++i) {
    integrator.step(motion);
  }
}

}  // namespace ibmfair::cloth
