#include "commands/vertex_list.h"

#include <charconv>
#include <cstdint>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

std::vector<Index> read_vertex_list(const std::string& path, Index vertex_count) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw BadFile(fmt::format("{}: cannot be read", path));
  }
  constexpr std::string_view separators = " \t\r\n,";
  std::vector<Index> vertices;
  std::string line;
  for (std::int64_t number = 1; std::getline(file, line); ++number) {
    std::string_view rest = std::string_view(line).substr(0, line.find('#'));
    for (auto begin = rest.find_first_not_of(separators); begin != std::string_view::npos;
         begin = rest.find_first_not_of(separators)) {
      rest.remove_prefix(begin);
      const std::string_view word = rest.substr(0, rest.find_first_of(separators));
      rest.remove_prefix(word.size());
      std::int64_t vertex = -1;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), vertex);
      const bool whole = error == std::errc() && end == word.data() + word.size();
      if (!whole || vertex < 0 || vertex >= vertex_count) {
        throw BadFile(fmt::format("{}:{}: '{}' is not a vertex number from 0 to {}", path, number,
                                  word, vertex_count - 1));
      }
      vertices.push_back(static_cast<Index>(vertex));
    }
  }
  if (file.bad()) {
    throw BadFile(fmt::format("{}: cannot be read", path));
  }
  return vertices;
}

}  // namespace ibmfair::commands
