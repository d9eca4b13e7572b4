// `smooth` on a mesh that all ranks share.
#pragma once

#include "commands/command.h"
#include "petsc_engine/communicator.h"

namespace ibmfair::petsc {

/// Declares the command; its runner is collective.
commands::Runner declare_shared_smooth(CLI::App& app, const Communicator& comm);

}  // namespace ibmfair::petsc
