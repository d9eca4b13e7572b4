#include "commands/batch/job.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"

namespace ibmfair::commands {

namespace {

void add_option_words(const CLI::Option& option, const Setting& setting,
                      std::vector<std::string>& words) {
  const std::string name = "--" + setting.key;
  if (is_flag(option) && setting.values.empty()) {
    words.push_back(name);
  }
  for (const std::string& value : setting.values) {
    if (value.empty()) {
      words.insert(words.end(), {name, value});
    } else {
      words.push_back(fmt::format("{}={}", name, value));
    }
  }
}

}  // namespace

std::vector<std::string> words_for(const CLI::App& command, const std::vector<Setting>& settings) {
  std::vector<std::string> words{command.get_name()};
  for (const CLI::Option* option : command.get_options()) {
    for (const Setting& setting : settings) {
      if (setting.positional != option->get_positional() || setting.key != key_of(*option)) {
        continue;
      }
      if (!setting.positional) {
        add_option_words(*option, setting, words);
        continue;
      }
      for (const std::string& value : setting.values) {
        // Without `./` the parser would take the value for an option.
        const bool looks_like_option = (value.starts_with('-') && value != "-") || value == "++";
        words.push_back(looks_like_option ? "./" + value : value);
      }
    }
  }
  return words;
}

}  // namespace ibmfair::commands
