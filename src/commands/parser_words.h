// The messages of the library that parses the command line, in plain words.
#pragma once

#include <string>

namespace ibmfair::commands {

/// The parser's own message about a mistake, in the words of the other messages; unchanged if it is
/// not one of those that are known.
std::string in_plain_words(const std::string& error);

}  // namespace ibmfair::commands
