// The output of `ibmfair --generate KIND`: man pages, and completion scripts for shells. A new kind
// is one function and one row in generators.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/usage/usage.h"

namespace ibmfair::commands {

struct Generator {
  std::string_view name;  ///< the KIND in --generate KIND
  /// The text for the program or, if `command` is not null, for one of its commands.
  std::string (*make)(const ProgramUsage& program, const CommandUsage* command);
};

std::span<const Generator> generators();
std::vector<std::string> generator_names();

/// A page for man(1), in the macros of man(7): `ibmfair.1`, or `ibmfair-COMMAND.1`.
std::string man_page(const ProgramUsage& program, const CommandUsage* command);

/// Scripts that complete commands, options, values and file names. They do not depend on `command`.
std::string bash_completion(const ProgramUsage& program, const CommandUsage* command);
std::string zsh_completion(const ProgramUsage& program, const CommandUsage* command);
std::string fish_completion(const ProgramUsage& program, const CommandUsage* command);

/// The values that a shell offers for an option: the choices if there are any, else the offers.
const std::vector<std::string>& offered_words(const OptionUsage& option);

/// The text with a backslash before each of these characters.
std::string with_backslashes(const std::string& text, std::string_view characters);

/// The help up to its first remark, for a list with one line per option.
std::string short_help_of(const OptionUsage& option);

}  // namespace ibmfair::commands
