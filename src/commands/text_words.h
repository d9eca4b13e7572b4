// Reads text files that contain lists of words.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace ibmfair::commands {

/// Calls take(word, line number) for every word of a file. Words are separated by white space or
/// commas; `#` starts a comment. Throws BadFile, with the option that names the file, if it cannot
/// be read.
void for_words(const std::string& option, const std::string& path,
               const std::function<void(std::string_view word, std::int64_t line)>& take);

}  // namespace ibmfair::commands
