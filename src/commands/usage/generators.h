// What `ibmfair --generate KIND` writes: files that other programs take the usage from. A new kind
// is one function and one row in generators.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/usage/usage.h"

namespace ibmfair::commands {

struct Generator {
  std::string_view name;  ///< as --generate takes it
  /// The text for the program, or for one of its commands where `command` is not null.
  std::string (*make)(const ProgramUsage& program, const CommandUsage* command);
};

std::span<const Generator> generators();
std::vector<std::string> generator_names();

/// A page for man(1), in the man(7) macros: `ibmfair.1`, or `ibmfair-COMMAND.1`.
std::string man_page(const ProgramUsage& program, const CommandUsage* command);

/// Scripts that complete commands, options, values and names of files; the same for any command.
std::string bash_completion(const ProgramUsage& program, const CommandUsage* command);
std::string zsh_completion(const ProgramUsage& program, const CommandUsage* command);
std::string fish_completion(const ProgramUsage& program, const CommandUsage* command);

/// The values that a shell offers: all choices where there are some.
const std::vector<std::string>& offered_words(const OptionUsage& option);

/// The help as far as its first remark, for a list in which each option has one line.
std::string short_help_of(const OptionUsage& option);

}  // namespace ibmfair::commands
