// A job: one command with its arguments, for any number of inputs.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// One argument, by the name that a job file calls it.
struct Setting {
  std::string key;
  bool positional = false;
  std::vector<std::string> values = {};  ///< none for a flag that is set
};

struct Job {
  std::string place;  ///< where it stands, as messages start: `jobs.json: job 3: `
  std::string command;
  std::vector<std::string> inputs = {};  ///< names or globs for the command's first file to read
  std::vector<Setting> settings = {};    ///< the other arguments; names of files are patterns
};

/// The program's arguments for that command with these settings, in the order of its declaration.
std::vector<std::string> words_for(const CLI::App& command, const std::vector<Setting>& settings);

}  // namespace ibmfair::commands
