// Parts of this program that are programs of their own.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair {

/// The path of the part of this name: beside the program (or the library, where it is a shared
/// one), or in libexec/ibmfair. Empty where it is not installed.
std::string find_helper(std::string_view name);

}  // namespace ibmfair
