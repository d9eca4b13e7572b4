// How --help looks.
#pragma once

#include <string>

#include "commands/usage/usage.h"

namespace ibmfair::commands {

/// The commands that most people need: the first three examples of the first command, and one of
/// the second.
std::string first_commands(const ProgramUsage& program, std::size_t width);

/// The help of the program, in lines of at most `width` columns.
std::string help_text(const ProgramUsage& program, std::size_t width);

/// The help of a command. Where it has many options, `all` explains all of them; else the groups
/// that few people need are lists of names.
std::string help_text(const CommandUsage& command, std::size_t width, bool all);

/// The width to write help in: that of the terminal, or of COLUMNS, within 80 to 110; 80 where
/// neither is known.
std::size_t help_width();

}  // namespace ibmfair::commands
