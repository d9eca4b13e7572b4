// A batch from its jobs to its exit code.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/batch_options.h"
#include "commands/batch/job.h"
#include "commands/console.h"
#include "commands/exit_code.h"

namespace ibmfair::commands {

/// Runs the jobs, or lists them, as the options say, which came from the arguments of `command`.
/// `journal` is where the record of the list goes
/// unless the options name another file. Returns ExitCode::not_reached where an item failed, and
/// 128 + signal where the batch was interrupted. Throws as expand_jobs and the journal do, before
/// anything is run.
ExitCode run_batch(const CLI::App& command, const std::vector<Job>& jobs,
                   const BatchOptions& options, const std::string& journal, Console& console);

}  // namespace ibmfair::commands
