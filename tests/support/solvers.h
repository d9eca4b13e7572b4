// The solvers that the program was built with.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/flow/linear_system/jacobian_solver.h"

namespace ibmfair::test {

/// The names of all solvers, without "auto".
inline std::vector<std::string> solvers() {
  std::vector<std::string> names;
  for (const JacobianBackend& backend : jacobian_backends()) {
    names.emplace_back(backend.name);
  }
  return names;
}

/// Whether the solver cholmod was built and finds what it loads.
inline bool has_cholmod() {
  return backend_as_published().name == "cholmod";
}

}  // namespace ibmfair::test
