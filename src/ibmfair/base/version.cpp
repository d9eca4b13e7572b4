#include "ibmfair/base/version.h"

#include <array>

#include <Eigen/Core>
#include <cholmod.h>
#include <fmt/format.h>

// OpenBLAS's own header clashes with CHOLMOD's; these two are all that is needed of it.
extern "C" {
char* openblas_get_config();
char* openblas_get_corename();
}

namespace ibmfair {

std::string version() {
  return IBMFAIR_VERSION;
}

std::vector<Component> component_versions() {
  std::array<int, 3> suitesparse{};
  std::array<int, 3> cholmod{};
  SuiteSparse_version(suitesparse.data());
  cholmod_version(cholmod.data());
  return {
      {"Eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"SuiteSparse", fmt::format("{}", fmt::join(suitesparse, "."))},
      {"CHOLMOD", fmt::format("{}", fmt::join(cholmod, "."))},
      {"BLAS", fmt::format("{}, kernels for {}", openblas_get_config(), openblas_get_corename())}};
}

}  // namespace ibmfair
