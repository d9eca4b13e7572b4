// Finds the helper programs that are installed together with this program.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair {

/// The path of the helper program `name`. Searched, in this order: the directory of this program
/// (or of the shared library that holds this code), ../libexec/ibmfair from there, and the
/// directory into which the build installs helpers. Empty if the helper is not installed.
std::string find_helper(std::string_view name);

}  // namespace ibmfair
