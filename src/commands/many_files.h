// `ibmfair COMMAND IN... --out-dir DIR`: runs one command on many files, without a job file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "commands/command.h"

namespace ibmfair::commands {

/// If the command maps one mesh (its argument IN) to one mesh (OUT), declares --out-dir and the
/// options of a batch. With --out-dir, all arguments are inputs, and the returned runner runs a
/// batch; otherwise it calls `run`.
Runner take_many_files(CLI::App& command, Runner run);

/// Whether --out-dir was given.
bool takes_many_files(const CLI::App& command);

/// The command's arguments as a job for `ibmfair batch`: effective_job(), or with --out-dir a job
/// for all files.
nlohmann::ordered_json job_of(const CLI::App& command);

}  // namespace ibmfair::commands
