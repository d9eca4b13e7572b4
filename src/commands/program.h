// The main function of the program.
#pragma once

namespace ibmfair::commands {

/// Parses the arguments, runs the command that they name, and prints errors to standard error.
/// Returns the exit code.
int run_program(int argc, const char* const* argv);

}  // namespace ibmfair::commands
