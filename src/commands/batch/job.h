// A job: one command with its arguments, for any number of inputs.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// One argument of a job, with its key in a job file.
struct Setting {
  std::string key;
  bool positional = false;
  std::vector<std::string> values = {};  ///< empty for a flag that is set
};

struct Job {
  std::string place;  ///< start of messages about the job: `jobs.json: job 3: `
  std::string command;
  std::vector<std::string> inputs = {};  ///< names or globs for the command's first input file
  std::vector<Setting> settings = {};    ///< other arguments; file names are patterns
};

/// The program's arguments that run `command` with these settings, in the order in which the
/// command declares its arguments.
std::vector<std::string> words_for(const CLI::App& command, const std::vector<Setting>& settings);

}  // namespace ibmfair::commands
