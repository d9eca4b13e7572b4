// A command's parsed arguments as a job for `ibmfair batch`.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// `{"command": ..., "input": ..., "output": ..., "options": {...}}` with what was given and every
/// default that is known beforehand. Running it is running the command with these arguments.
nlohmann::ordered_json effective_job(const CLI::App& command);

/// Every option in force by name, also those that a job file does not take: what was given, and
/// defaults that are known beforehand. Without --json and --threads, which a batch adds to its jobs
/// and which change nothing that a report tells.
nlohmann::ordered_json options_in_force(const CLI::App& command);

/// The job file that holds these jobs. Throws BadOption for a text that is not UTF-8.
std::string job_file_text(const std::vector<nlohmann::ordered_json>& jobs);

}  // namespace ibmfair::commands
