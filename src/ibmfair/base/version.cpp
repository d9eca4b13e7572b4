#include "ibmfair/base/version.h"

#include <Eigen/Core>
#include <amd.h>
#include <fmt/format.h>

#include "ibmfair/base/instruction_set.h"

namespace ibmfair {

std::string_view version() {
  return IBMFAIR_VERSION;
}

std::vector<Component> component_versions() {
  return {{"Eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"AMD", fmt::format("{}.{}.{}", AMD_MAIN_VERSION, AMD_SUB_VERSION, AMD_SUBSUB_VERSION)},
          {"kernels", std::string(kernel_set_name())}};
}

}  // namespace ibmfair
