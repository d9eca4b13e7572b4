#include "commands/usage/generators.h"

#include <algorithm>
#include <array>

namespace ibmfair::commands {

std::span<const Generator> generators() {
  static constexpr std::array table{
      Generator{"man", man_page},           Generator{"bash", bash_completion},
      Generator{"zsh", zsh_completion},     Generator{"fish", fish_completion},
      Generator{"markdown", option_tables},
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

std::string short_help_of(const OptionUsage& option) {
  std::size_t end = option.help.size();
  for (const char* mark : {"; ", ": ", " (", ", as ", ", and "}) {
    end = std::min(end, option.help.find(mark));
  }
  return option.help.substr(0, end);
}

std::string in_single_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

}  // namespace ibmfair::commands
