#include <fmt/format.h>

#include "commands/batch/shell_words.h"
#include "commands/usage/generators.h"

namespace ibmfair::commands {

namespace {

constexpr const char* zsh_start = R"(#compdef ibmfair
# zsh completion for ibmfair; written by `ibmfair --generate zsh`

_ibmfair() {
  local curcontext=$curcontext state line
  typeset -A opt_args
)";

/// Escapes the text for a specification, in which brackets and colons have a meaning.
std::string zsh_text(const std::string& text) {
  return with_backslashes(text, "[]:\\");
}

/// The action that offers the values of an option or argument. If no file has one of the
/// extensions, _files offers all files.
std::string zsh_action(const OptionUsage& option) {
  const std::vector<std::string>& words = offered_words(option);
  if (!words.empty()) {
    return fmt::format("({})", fmt::join(words, " "));
  }
  if (option.type == "directory") {
    return "_files -/";
  }
  if (option.role == Role::value) {
    return " ";
  }
  return option.extensions.empty()
             ? "_files"
             : fmt::format("_files -g \"(#i)*.({})(-.)\"", fmt::join(option.extensions, "|"));
}

/// One specification for each name of the option.
std::string zsh_option(const OptionUsage& option) {
  std::vector<std::string> names{option.name};
  if (!option.letter.empty()) {
    names.push_back(option.letter);
  }
  std::vector<std::string> others = option.excludes;
  others.insert(others.end(), names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) {
    std::string specification =
        fmt::format("({}){}{}[{}]", fmt::join(others, " "), name, option.value.empty() ? "" : "=",
                    zsh_text(short_help_of(option)));
    if (!option.value.empty()) {
      specification += fmt::format(
          ":{}:{}", option.choices.empty() ? zsh_text(option.value) : "value", zsh_action(option));
    }
    text += fmt::format("          {} \\\n", in_single_quotes(specification));
  }
  return text;
}

std::string zsh_command(const CommandUsage& command) {
  std::string text = fmt::format("        {})\n          _arguments -S \\\n", command.name);
  for (const OptionUsage& option : command.options) {
    text += "  " + zsh_option(option);
  }
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const OptionUsage& argument = command.arguments[i];
    // The last argument also covers all further words, because it may take many files.
    const bool last = i + 1 == command.arguments.size();
    const std::string specification = fmt::format("{}:{}:{}", last ? "*" : fmt::format("{}", i + 1),
                                                  zsh_text(argument.name), zsh_action(argument));
    text += fmt::format("            {}{}", in_single_quotes(specification), last ? "\n" : " \\\n");
  }
  return text + "          ;;\n";
}

std::string zsh_names(const ProgramUsage& program) {
  std::string text = "      local -a commands=(\n";
  for (const CommandUsage& command : program.commands) {
    text += fmt::format("        {}\n", in_single_quotes(fmt::format("{}:{}", command.name,
                                                                     zsh_text(command.summary))));
  }
  return text + "      )\n";
}

}  // namespace

std::string zsh_completion(const ProgramUsage& program, const CommandUsage* /*command*/) {
  std::string text = zsh_start;
  text += "  _arguments -C -S \\\n";
  for (const OptionUsage& option : program.options) {
    text += zsh_option(option);
  }
  text +=
      "          '1: :->command' '*:: :->arguments' && return\n  case $state in\n    command)\n";
  text += zsh_names(program);
  text +=
      "      commands+=('help:tell all about a command')\n      _describe command commands\n"
      "      ;;\n    arguments)\n      case $words[1] in\n";
  for (const CommandUsage& command : program.commands) {
    text += zsh_command(command);
  }
  text += "        help)\n    ";
  text += zsh_names(program);
  return text +
         "          _describe command commands\n          ;;\n      esac\n      ;;\n  esac\n}\n"
         "\n_ibmfair \"$@\"\n";
}

}  // namespace ibmfair::commands
