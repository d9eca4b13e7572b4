// The text of --help.
#pragma once

#include <string>

#include "commands/usage/usage.h"

namespace ibmfair::commands {

/// Examples of the most common commands: the first three examples of the first command, and the
/// first example of the second command.
std::string first_commands(const ProgramUsage& program, std::size_t width);

/// The help of the program, in lines of at most `width` columns.
std::string help_text(const ProgramUsage& program, std::size_t width);

/// The help of a command. If the command has many options and not `all`, the groups of options that
/// few users need are listed by name only.
std::string help_text(const CommandUsage& command, std::size_t width, bool all);

/// The number of columns of help texts: COLUMNS if set, else the width of the terminal, clamped to
/// 80 to 110; 80 if neither is known.
std::size_t help_width();

}  // namespace ibmfair::commands
