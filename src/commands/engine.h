// Engines, the programs that compute a run of `smooth`. A separate program distributes a mesh over
// the processes of mpirun, so that this program does not link MPI.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

inline constexpr const char* single_engine = "single";
inline constexpr const char* petsc_engine = "petsc";

/// If the arguments (`words`, without the program's name) select the PETSc engine and that program
/// is installed, this process executes it (and the function does not return); otherwise returns.
void become_engine(const std::vector<std::string>& words, const char* const* argv);

/// Throws BadOption unless `engine` is the single process; the message says what is missing.
void require_single_engine(const std::string& engine);

}  // namespace ibmfair::commands
