#include <algorithm>

#include <fmt/format.h>

#include "commands/usage/generators.h"

namespace ibmfair::commands {

namespace {

/// The text in a cell of a table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '|' ? "\\|" : std::string(1, c);
  }
  return result;
}

bool is_same(const OptionUsage& a, const OptionUsage& b) {
  return heading_of(a) == heading_of(b) && a.help == b.help && a.unit == b.unit &&
         a.default_value == b.default_value && a.default_text == b.default_text;
}

/// The commands that have this very option.
std::vector<std::string> commands_with(const OptionUsage& option, const ProgramUsage& program) {
  std::vector<std::string> names;
  for (const CommandUsage& command : program.commands) {
    if (std::any_of(command.options.begin(), command.options.end(),
                    [&](const OptionUsage& other) { return is_same(option, other); })) {
      names.push_back(command.name);
    }
  }
  return names;
}

std::string table_row(const OptionUsage& option, const std::string& last_cell) {
  return fmt::format("| `{}` | {} | {} | {} |{}\n", cell(heading_of(option)), cell(option.help),
                     cell(option.unit), cell(option.default_value + option.default_text),
                     last_cell);
}

}  // namespace

std::string option_tables(const ProgramUsage& program, const CommandUsage* /*command*/) {
  std::string text, shared;
  std::vector<OptionUsage> done;
  for (const CommandUsage& command : program.commands) {
    std::string own;
    for (const OptionUsage& option : command.options) {
      const std::vector<std::string> names = commands_with(option, program);
      if (names.size() == 1) {
        own += table_row(option, "");
      } else if (std::none_of(done.begin(), done.end(),
                              [&](const OptionUsage& other) { return is_same(option, other); })) {
        done.push_back(option);
        shared += table_row(option,
                            fmt::format(" {} |", names.size() == program.commands.size()
                                                     ? "all"
                                                     : fmt::format("{}", fmt::join(names, ", "))));
      }
    }
    if (!own.empty()) {
      text += fmt::format(
          "Of `{}` alone:\n\n| option | meaning | unit | default |\n|---|---|---|---|\n{}\n",
          command.name, own);
    }
  }
  return text + fmt::format(
                    "Of several commands:\n\n| option | meaning | unit | default | commands |\n"
                    "|---|---|---|---|---|\n{}",
                    shared);
}

}  // namespace ibmfair::commands
