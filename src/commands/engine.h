// Engines, the programs that compute a run of `smooth`. A separate program distributes a mesh over
// the processes of mpirun, so that this program does not link MPI.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// Declares --engine, with which PETSc's own options may follow the arguments of the command.
void add_engine_option(CLI::App& command, std::string& engine);

/// Whether the command's arguments end with options that are for PETSc.
bool passes_options_on(const CLI::App& command);

/// If the parsed arguments select the PETSc engine and that program is installed, this process
/// executes it with the arguments `argv` (and the function does not return); otherwise returns.
void become_engine(const CLI::App& command, const char* const* argv);

/// Throws BadOption unless `engine` is the single process; the message says what is missing.
void require_single_engine(const std::string& engine);

}  // namespace ibmfair::commands
