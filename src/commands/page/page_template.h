// The template of the HTML page. It is embedded in the executable, so the system loads it from disk
// only when it is used.
#pragma once

#include <string_view>

namespace ibmfair::commands {

/// The HTML text with placeholders; empty if the program was built without the page.
std::string_view page_template();

}  // namespace ibmfair::commands
