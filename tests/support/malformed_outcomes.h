// What becomes of the odd and hostile files of the shared collection, as it is checked in.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ibmfair::test {

/// The end of one run.
struct Outcome {
  int exit_code = -1;
  std::string message;  ///< of an error; empty where the program did something

  bool operator==(const Outcome&) const = default;
};

/// By file (as `obj/afl_00.obj`), then by command.
using Outcomes = std::map<std::string, std::map<std::string, Outcome>>;

/// The commands that each file goes through.
const std::vector<std::string>& outcome_commands();

/// `tests/malformed_outcomes.tsv`: a line has a file, commands, their exit code, their message.
Outcomes expected_outcomes();

/// The same text for other outcomes; commands that end alike share a line.
std::string outcomes_text(const Outcomes& outcomes);

/// Where that table is.
std::string outcomes_path();

}  // namespace ibmfair::test
