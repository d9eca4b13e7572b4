// Arguments as they are typed into a shell.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

/// The text between single quotes, as shells read it.
std::string in_single_quotes(const std::string& text);

/// The words separated by spaces, each quoted if a shell would otherwise change or split it.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace ibmfair::commands
