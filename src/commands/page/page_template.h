// The built page, a part of the program's file that is read from disk only where it is used.
#pragma once

#include <string_view>

namespace ibmfair::commands {

/// The HTML with its placeholders; empty where the program was built without.
std::string_view page_template();

}  // namespace ibmfair::commands
