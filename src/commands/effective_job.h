// A command's parsed arguments as a job for `ibmfair batch`.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// The job `{"command": ..., "input": ..., "output": ..., "options": {...}}` with the given
/// arguments and every default value that is known before the run. Running the job is equivalent to
/// running the command with its arguments.
nlohmann::ordered_json effective_job(const CLI::App& command);

/// The values of all options, given or default, by name, including options that a job file does not
/// take. --json and --threads are left out, because a batch adds them to its jobs and they do not
/// change the content of a report.
nlohmann::ordered_json options_in_force(const CLI::App& command);

/// The text of a job file with these jobs. Throws BadOption if a name or value is not UTF-8.
std::string job_file_text(const std::vector<nlohmann::ordered_json>& jobs);

}  // namespace ibmfair::commands
