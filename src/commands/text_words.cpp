#include "commands/text_words.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

void for_words(const std::string& option, const std::string& path,
               const std::function<void(std::string_view word, std::int64_t line)>& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw BadFile(fmt::format("{}: {}: cannot be read: {}", option, path, std::strerror(errno)));
  }
  constexpr std::string_view separators = " \t\r\n,";
  std::string line;
  for (std::int64_t number = 1; std::getline(file, line); ++number) {
    std::string_view rest = std::string_view(line).substr(0, line.find('#'));
    for (auto begin = rest.find_first_not_of(separators); begin != std::string_view::npos;
         begin = rest.find_first_not_of(separators)) {
      rest.remove_prefix(begin);
      const std::string_view word = rest.substr(0, rest.find_first_of(separators));
      rest.remove_prefix(word.size());
      take(word, number);
    }
  }
  if (file.bad()) {
    throw BadFile(fmt::format("{}: {}: cannot be read: {}", option, path, std::strerror(errno)));
  }
}

}  // namespace ibmfair::commands
