// Versions: of the library, and of what it is built on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ibmfair {

/// The library's own version, as "0.1.0".
std::string_view version();

struct Component {
  std::string name;
  std::string version;
};

/// What the running program computes with, as found at run time where the component tells: Eigen,
/// SuiteSparse, CHOLMOD, and the instructions that kernels use.
std::vector<Component> component_versions();

}  // namespace ibmfair
