#include <fmt/format.h>

#include "commands/usage/generators.h"

namespace ibmfair::commands {

namespace {

// bash splits `--option=value` into three words. Files without one of the wanted extensions are
// offered only if no file has a wanted extension.
constexpr const char* bash_start =
    R"(# bash completion for ibmfair; written by `ibmfair --generate bash`

_ibmfair_files() {
  local extension
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    for extension in "$@"; do
      compgen -f -X "!*.$extension" -- "$cur"
      compgen -f -X "!*.${extension^^}" -- "$cur"
    done
  )
  ((${#COMPREPLY[@]})) || mapfile -t COMPREPLY < <(compgen -f -- "$cur")
  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$cur")
  mapfile -t COMPREPLY < <(printf '%s\n' "${COMPREPLY[@]}" | sort -u | sed '/^$/d')
}

_ibmfair_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

_ibmfair() {
  local cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  local command= with_values= options= position=0 i
  COMPREPLY=()
  if [[ $cur == = ]]; then
    cur=
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]}; break; }
  done
  case $command in
)";

constexpr const char* bash_middle = R"(  esac
  for ((++i; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      ((++position))
    elif [[ " $with_values " == *" ${COMP_WORDS[i]} "* ]]; then
      [[ ${COMP_WORDS[i+1]-} != = ]] || ((++i))
      ((++i))
    fi
  done
  case "$command $previous" in
)";

constexpr const char* bash_options = R"(  esac
  if [[ $cur == -* ]]; then
    _ibmfair_words "$options"
    return
  fi
  case "$command $position" in
)";

constexpr const char* bash_end = R"(  esac
}

complete -F _ibmfair ibmfair
)";

/// The shell command that offers the values of an option or argument.
std::string bash_action(const OptionUsage& option) {
  const std::vector<std::string>& words = offered_words(option);
  if (!words.empty()) {
    return fmt::format("_ibmfair_words '{}'", fmt::join(words, " "));
  }
  if (option.type == "directory") {
    return "compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\")";
  }
  return option.role == Role::value
             ? ":"
             : fmt::format("_ibmfair_files {}", fmt::join(option.extensions, " "));
}

std::string bash_words(const std::vector<OptionUsage>& options, bool with_values_only) {
  std::string text;
  for (const OptionUsage& option : options) {
    if (!with_values_only || !option.value.empty()) {
      text += (text.empty() ? "" : " ") + option.name;
      text += option.letter.empty() ? "" : fmt::format(" {}", option.letter);
    }
  }
  return text;
}

std::string bash_lists(const std::string& command, const std::vector<OptionUsage>& options) {
  return fmt::format("    {})\n      options='{}'\n      with_values='{}'\n      ;;\n", command,
                     bash_words(options, false), bash_words(options, true));
}

std::string bash_values(const std::string& command, const std::vector<OptionUsage>& options) {
  std::string text;
  for (const OptionUsage& option : options) {
    if (!option.value.empty()) {
      text +=
          fmt::format("    '{} {}') {}; return ;;\n", command, option.name, bash_action(option));
    }
  }
  return text;
}

std::string bash_arguments(const CommandUsage& command) {
  std::string text;
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    // The last argument also covers all further words, because it may take many files.
    const bool last = i + 1 == command.arguments.size();
    text += fmt::format("    '{} '{}) {} ;;\n", command.name, last ? "*" : fmt::format("{}", i),
                        bash_action(command.arguments[i]));
  }
  return text;
}

}  // namespace

std::string bash_completion(const ProgramUsage& program, const CommandUsage* /*command*/) {
  std::string names, lists = bash_lists("''", program.options);
  std::string values = bash_values("", program.options), arguments;
  for (const CommandUsage& command : program.commands) {
    names += command.name + " ";
    lists += bash_lists(command.name, command.options);
    values += bash_values(command.name, command.options);
    arguments += bash_arguments(command);
  }
  return bash_start + lists + bash_middle + values + bash_options +
         fmt::format("    ' 0') _ibmfair_words '{}help' ;;\n    'help 0') _ibmfair_words '{}' ;;\n",
                     names, names) +
         arguments + bash_end;
}

}  // namespace ibmfair::commands
