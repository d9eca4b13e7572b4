// Engines: what a run of `smooth` is computed by. A mesh that is shared among the processes of
// mpirun is the business of a program of its own, so that this one does not link MPI.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

inline constexpr const char* single_engine = "single";
inline constexpr const char* petsc_engine = "petsc";

/// Where the arguments (`words`, without the program's name) ask for the PETSc engine and it is
/// installed, this process goes on as that; otherwise the function returns.
void become_engine(const std::vector<std::string>& words, const char* const* argv);

/// Throws BadOption that tells what is missing, unless the engine is the single process.
void require_single_engine(const std::string& engine);

}  // namespace ibmfair::commands
