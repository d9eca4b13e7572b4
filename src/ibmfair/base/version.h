// Versions of the library and of the libraries that it uses.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ibmfair {

/// The version of this library, such as "0.1.0".
std::string_view version();

struct Component {
  std::string name;
  std::string version;
};

/// The components that the running program computes with (Eigen, SuiteSparse, CHOLMOD, and the
/// instruction set of the kernels); versions are asked for at run time if the component can tell.
std::vector<Component> component_versions();

}  // namespace ibmfair
