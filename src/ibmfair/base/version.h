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

/// What every run of the program computes with: Eigen, AMD of SuiteSparse, and the instruction set
/// of the kernels. What single solvers load in addition is in the table of
/// flow/linear_system/jacobian_backends.cpp.
std::vector<Component> component_versions();

}  // namespace ibmfair
