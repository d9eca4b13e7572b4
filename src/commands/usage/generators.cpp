#include "commands/usage/generators.h"

#include <algorithm>
#include <array>

namespace ibmfair::commands {

std::span<const Generator> generators() {
  static constexpr std::array table{
      Generator{"man", man_page},
      Generator{"bash", bash_completion},
      Generator{"zsh", zsh_completion},
      Generator{"fish", fish_completion},
  };
  return table;
}

std::vector<std::string> generator_names() {
  std::vector<std::string> names;
  for (const Generator& generator : generators()) {
    names.emplace_back(generator.name);
  }
  return names;
}

const std::vector<std::string>& offered_words(const OptionUsage& option) {
  return option.choices.empty() ? option.offers : option.choices;
}

std::string with_backslashes(const std::string& text, std::string_view characters) {
  std::string result;
  for (const char c : text) {
    result.append(characters.find(c) == std::string_view::npos ? "" : "\\") += c;
  }
  return result;
}

std::string short_help_of(const OptionUsage& option) {
  std::size_t end = option.help.size();
  for (const char* mark : {"; ", ": ", " (", ", as ", ", and "}) {
    end = std::min(end, option.help.find(mark));
  }
  return option.help.substr(0, end);
}

}  // namespace ibmfair::commands
