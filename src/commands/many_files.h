// `ibmfair COMMAND IN... --out-dir DIR`: the short way to run one command over many files.
#pragma once

#include <string>
#include <vector>

#include "commands/command.h"

namespace ibmfair::commands {

/// Whether the program's arguments ask for it.
bool asks_for_many_files(const std::vector<std::string>& words);

/// Declares --out-dir and what goes with it, where the command maps one mesh (its argument IN) to
/// one mesh (OUT). If this was `asked` for, IN becomes any number of files, OUT vanishes, and the
/// runner returned does a batch; otherwise it is `run`.
Runner take_many_files(CLI::App& command, Runner run, bool asked);

/// For a message about an argument too many: ` (--out-dir DIR takes many files)`, or nothing where
/// the command does not.
std::string many_files_hint(const CLI::App& command);

}  // namespace ibmfair::commands
