// `ibmfair COMMAND IN... --out-dir DIR`: runs one command on many files, without a job file.
#pragma once

#include <string>
#include <vector>

#include "commands/command.h"

namespace ibmfair::commands {

/// Whether the program's arguments contain --out-dir.
bool asks_for_many_files(const std::vector<std::string>& words);

/// If the command maps one mesh (its argument IN) to one mesh (OUT), declares --out-dir and the
/// options of a batch. If also `asked`, IN takes any number of files, OUT is removed, and the
/// returned runner runs a batch; otherwise the returned runner calls `run`.
Runner take_many_files(CLI::App& command, Runner run, bool asked);

/// A hint for messages about an argument too many: ` (--out-dir DIR takes many files)`, or an empty
/// string if the command has no --out-dir, or if it was given.
std::string many_files_hint(const CLI::App& command);

}  // namespace ibmfair::commands
