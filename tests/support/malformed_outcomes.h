// The outcomes of runs on the odd and hostile files of the shared collection, as the checked-in
// table records them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ibmfair::test {

/// How one run ended.
struct Outcome {
  int exit_code = -1;
  std::string message;  ///< the error message; empty if the program did its work

  bool operator==(const Outcome&) const = default;
};

/// Outcomes by file (for example `obj/afl_00.obj`), then by command.
using Outcomes = std::map<std::string, std::map<std::string, Outcome>>;

/// The commands that are run on each file.
const std::vector<std::string>& outcome_commands();

/// Reads `tests/malformed_outcomes.tsv`. A line has a file, commands, their exit code and their
/// message.
Outcomes expected_outcomes();

/// The text of such a table for other outcomes; commands that end alike share a line.
std::string outcomes_text(const Outcomes& outcomes);

/// The path of `tests/malformed_outcomes.tsv`.
std::string outcomes_path();

}  // namespace ibmfair::test
