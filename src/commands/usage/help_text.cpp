#include "commands/usage/help_text.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

#include "commands/terminal_line.h"

namespace ibmfair::commands {

namespace {

constexpr std::size_t left_column = 26;
constexpr std::size_t narrowest = 80, widest = 110;

/// Breaks the text into lines of at most `width` columns. The first line begins at column `start`,
/// the others are indented by `indent` blanks.
std::string wrapped(const std::string& text, std::size_t start, std::size_t indent,
                    std::size_t width) {
  std::istringstream words(text);
  std::string result;
  std::size_t column = start;
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (!first && column + 1 + word.size() > width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

/// Breaks a list of choices, `a|b|c`, at its bars if it does not fit into one line.
std::string broken_at_bars(std::string line, std::size_t width) {
  std::string result;
  while (line.size() > width) {
    const std::size_t bar = line.rfind('|', width - 1);
    if (bar == std::string::npos) {
      break;
    }
    result += line.substr(0, bar + 1) + "\n";
    line = std::string(6, ' ') + line.substr(bar + 1);
  }
  return result + line;
}

/// An entry `  heading   text` with the text in its own column.
std::string entry(const std::string& heading, const std::string& text, std::size_t width) {
  std::string line = fmt::format("  {}", heading);
  if (line.size() + 2 > left_column) {
    line = broken_at_bars(line, width) + "\n" + std::string(left_column, ' ');
  } else {
    line.resize(left_column, ' ');
  }
  return line + wrapped(text, left_column, left_column, width) + "\n";
}

/// The help of a command with more options than this explains only the first groups, unless --all
/// is given.
constexpr std::size_t most_options = 24;

/// Whether a group has options that few users need.
bool is_further(const std::string& group) {
  using namespace groups;
  return group == energy_and_flow || group == solver_and_memory || group == input_and_output ||
         group == many_files || group == every_command;
}

std::string option_group(const std::string& group, const std::vector<OptionUsage>& options,
                         std::size_t width) {
  std::string text = fmt::format("\n{}:\n", group);
  for (const OptionUsage& option : options) {
    if (option.group == group) {
      text += entry(heading_of(option), full_help_of(option, options), width);
    }
  }
  return text;
}

std::string names_in_group(const std::string& group, const std::vector<OptionUsage>& options) {
  std::vector<std::string> names;
  for (const OptionUsage& option : options) {
    if (option.group == group) names.push_back(option.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string option_groups(const std::vector<OptionUsage>& options, std::size_t width) {
  std::string text;
  for (const std::string& group : groups_of(options)) {
    text += option_group(group, options, width);
  }
  return text;
}

/// The first groups with explanations, and the names of the options in the other groups.
std::string first_option_groups(const CommandUsage& command, std::size_t width) {
  std::string first;
  std::string further =
      fmt::format("\nFurther options, which `ibmfair help {} --all` explains:\n", command.name);
  for (const std::string& group : groups_of(command.options)) {
    if (is_further(group)) {
      further += entry(group, names_in_group(group, command.options), width);
    } else {
      first += option_group(group, command.options, width);
    }
  }
  return first + further;
}

std::string example_list(std::span<const Example> examples, std::size_t width) {
  std::string text;
  for (const Example& example : examples) {
    text += fmt::format("  {}\n      {}\n", example.command, wrapped(example.meaning, 6, 6, width));
  }
  return text;
}

std::size_t terminal_width() {
  const std::size_t columns = terminal_columns(STDOUT_FILENO);
  return columns > 0 ? columns : terminal_columns(STDERR_FILENO);
}

}  // namespace

std::string first_commands(const ProgramUsage& program, std::size_t width) {
  constexpr std::array<std::size_t, 2> most{3, 1};
  std::string text = "What most people need:\n";
  for (std::size_t c = 0; c < std::min(most.size(), program.commands.size()); ++c) {
    const std::span<const Example> examples = program.commands[c].examples;
    text += example_list(examples.first(std::min(most[c], examples.size())), width);
  }
  return text;
}

std::string help_text(const ProgramUsage& program, std::size_t width) {
  std::string text =
      fmt::format("{}\n\nUsage: ibmfair COMMAND [ARGUMENT...] [OPTION...]\n\n{}",
                  wrapped(program.summary, 0, 0, width), first_commands(program, width));
  text += "\nCommands:\n";
  for (const CommandUsage& command : program.commands) {
    text += entry(command.name, command.summary, width);
  }
  text += entry("help COMMAND", "explain a command: arguments, options, examples", width);
  text += option_groups(program.options, width) + "\nExit codes:\n";
  for (const ExitCodeUsage& row : program.exit_codes) {
    text += fmt::format("  {:<10}{}\n", row.code, wrapped(row.meaning, 12, 12, width));
  }
  return text;
}

std::string help_text(const CommandUsage& command, std::size_t width, bool all) {
  all = all || command.options.size() <= most_options;
  std::string text = fmt::format("{}\n\nUsage: {}\n\nExamples:\n{}\nArguments:\n",
                                 wrapped(command.summary, 0, 0, width), synopsis_of(command),
                                 example_list(command.examples, width));
  for (const OptionUsage& argument : command.arguments) {
    text += entry(argument.name, full_help_of(argument, {}), width);
  }
  text += all ? option_groups(command.options, width) : first_option_groups(command, width);
  for (const Section& section : command.sections) {
    if (section.further && !all) continue;
    text += fmt::format("\n{}:\n", section.title);
    std::istringstream lines(section.text);
    for (std::string line; std::getline(lines, line);) {
      text += line.empty() ? "\n" : fmt::format("  {}\n", line);
    }
  }
  return text;
}

std::size_t help_width() {
  const char* given = std::getenv("COLUMNS");
  const unsigned long columns = given == nullptr ? 0 : std::strtoul(given, nullptr, 10);
  return std::clamp<std::size_t>(columns > 0 ? columns : terminal_width(), narrowest, widest);
}

}  // namespace ibmfair::commands
