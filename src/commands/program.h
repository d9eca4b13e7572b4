// The program: from its arguments to its exit code.
#pragma once

namespace ibmfair::commands {

/// Parses the arguments by the table of commands, runs the one that they name, and tells on
/// standard error what went wrong. Returns the exit code.
int run_program(int argc, const char* const* argv);

}  // namespace ibmfair::commands
