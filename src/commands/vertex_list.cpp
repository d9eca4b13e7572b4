#include "commands/vertex_list.h"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "commands/text_words.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

std::vector<Index> read_vertex_list(const std::string& option, const std::string& path,
                                    Index vertex_count) {
  std::vector<Index> vertices;
  for_words(option, path, [&](std::string_view word, std::int64_t line) {
    std::int64_t vertex = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), vertex);
    const bool whole = error == std::errc() && end == word.data() + word.size();
    if (!whole || vertex < 0 || vertex >= vertex_count) {
      throw BadFile(fmt::format("{}: {}:{}: '{}' is not a vertex number from 0 to {}", option, path,
                                line, word, vertex_count - 1));
    }
    vertices.push_back(static_cast<Index>(vertex));
  });
  return vertices;
}

}  // namespace ibmfair::commands
