// Arguments as one types them.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

/// The text between single quotes, as shells read it.
std::string in_single_quotes(const std::string& text);

/// The words separated by spaces, quoted where a shell would otherwise take them apart.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace ibmfair::commands
