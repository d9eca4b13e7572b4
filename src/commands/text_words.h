// Text files of words, as people write lists.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace ibmfair::commands {

/// Calls take(word, line number) for all words of a file, which white space or commas separate; `#`
/// starts a comment. Throws BadFile where the file cannot be read.
void for_words(const std::string& path,
               const std::function<void(std::string_view word, std::int64_t line)>& take);

}  // namespace ibmfair::commands
