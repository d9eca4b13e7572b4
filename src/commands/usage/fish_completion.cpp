#include <fmt/format.h>

#include "commands/usage/generators.h"

namespace ibmfair::commands {

namespace {

constexpr const char* fish_start =
    R"(# fish completion for ibmfair; written by `ibmfair --generate fish`

# Whether this is the command; with a number, whether that many words stand before the cursor.
function __ibmfair_on
    set -l words (commandline -opc)
    test (count $words) -ge 2; and test $words[2] = $argv[1]; or return 1
    test (count $argv) -lt 2; or test (count $words) -eq $argv[2]
end

# Files with one of these extensions first, and folders, then all others.
function __ibmfair_files
    set -l word (string replace -r '^--[^=]*=' '' -- (commandline -ct))
    set -l files (complete -C "__fish_command_without_completions $word" | string replace -r '\t.*' '')
    set -l wanted '(?i)(/|\.('$argv[1]'))$'
    string match -er -- $wanted $files
    string match -erv -- $wanted $files
end

complete -c ibmfair -f
complete -c ibmfair -n __fish_use_subcommand -a help -d 'tell all about a command'
)";

/// The text in single quotes, within which fish requires quotes and backslashes to be escaped.
std::string fish_text(const std::string& text) {
  return "'" + with_backslashes(text, "'\\") + "'";
}

/// The arguments of `complete` that offer the values of an option or argument; files with the
/// wanted extensions come first.
std::string fish_action(const OptionUsage& option) {
  const std::vector<std::string>& words = offered_words(option);
  if (!words.empty()) {
    return fmt::format(" -xa '{}'", fmt::join(words, " "));
  }
  if (option.type == "directory") {
    return " -xa '(__fish_complete_directories (commandline -ct))'";
  }
  if (option.role == Role::value) {
    return " -x";
  }
  return option.extensions.empty()
             ? " -rF"
             : fmt::format(" -kxa '(__ibmfair_files \"{}\")'", fmt::join(option.extensions, "|"));
}

std::string fish_option(const std::string& condition, const OptionUsage& option) {
  std::string text =
      fmt::format("complete -c ibmfair -n {} -l {}", fish_text(condition), option.name.substr(2));
  if (!option.letter.empty()) {
    text += fmt::format(" -s {}", option.letter.substr(1));
  }
  if (!option.value.empty()) {
    text += fish_action(option);
  }
  return text + fmt::format(" -d {}\n", fish_text(short_help_of(option)));
}

std::string fish_arguments(const CommandUsage& command) {
  std::string text, condition = "__ibmfair_on " + command.name;
  for (const OptionUsage& argument : command.arguments) {
    if (argument.choices.empty() && argument.offers.empty()) {
      text += fmt::format("complete -c ibmfair -n '{}'{}\n", condition, fish_action(argument));
    } else {  // words are offered for the first argument, and only words
      text += fmt::format("complete -c ibmfair -n '{} 2'{}\n", condition, fish_action(argument));
      condition += fmt::format("; and not __ibmfair_on {} 2", command.name);
    }
  }
  return text;
}

}  // namespace

std::string fish_completion(const ProgramUsage& program, const CommandUsage* /*command*/) {
  std::string text = fish_start;
  for (const OptionUsage& option : program.options) {
    text += fish_option("__fish_use_subcommand", option);
  }
  for (const CommandUsage& command : program.commands) {
    text += fmt::format("\ncomplete -c ibmfair -n __fish_use_subcommand -a {} -d {}\n",
                        command.name, fish_text(command.summary));
    text += fmt::format("complete -c ibmfair -n '__ibmfair_on help 2' -a {}\n", command.name);
    text += fish_arguments(command);
    for (const OptionUsage& option : command.options) {
      text += fish_option("__ibmfair_on " + command.name, option);
    }
  }
  return text;
}

}  // namespace ibmfair::commands
