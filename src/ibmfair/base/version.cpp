#include "ibmfair/base/version.h"

#include <array>

#include <Eigen/Core>
#include <cholmod.h>
#include <fmt/format.h>

#include "ibmfair/base/instruction_set.h"

namespace ibmfair {

std::string_view version() {
  return IBMFAIR_VERSION;
}

std::vector<Component> component_versions() {
  std::array<int, 3> suitesparse{};
  std::array<int, 3> cholmod{};
  SuiteSparse_version(suitesparse.data());
  cholmod_version(cholmod.data());
  return {{"Eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"SuiteSparse", fmt::format("{}", fmt::join(suitesparse, "."))},
          {"CHOLMOD", fmt::format("{}", fmt::join(cholmod, "."))},
          {"kernels", std::string(kernel_set_name())}};
}

}  // namespace ibmfair
