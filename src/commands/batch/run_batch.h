// Runs a whole batch, from the list of jobs to the exit code.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/batch_options.h"
#include "commands/batch/job.h"
#include "commands/console.h"
#include "commands/exit_code.h"

namespace ibmfair::commands {

/// Runs or lists the jobs, depending on `options`, which were parsed from the arguments of
/// `command`. `journal` is the path of the list's journal unless the options name another file.
/// Returns ExitCode::not_reached if an item failed, and 128 + signal if the batch was interrupted.
/// Throws the exceptions of expand_jobs and Journal before any item is run.
ExitCode run_batch(const CLI::App& command, const std::vector<Job>& jobs,
                   const BatchOptions& options, const std::string& journal, Console& console);

}  // namespace ibmfair::commands
