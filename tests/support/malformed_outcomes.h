// How the program ends on odd and hostile files; for those of the shared collection, the checked-in
// table has the outcomes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace ibmfair::test {

/// How one run ended.
struct Outcome {
  int exit_code = -1;
  std::string message = {};  ///< the error message; empty if the program did its work

  bool operator==(const Outcome&) const = default;
};

/// Outcomes by command.
using CommandOutcomes = std::map<std::string, Outcome>;

/// Outcomes by file (for example `obj/afl_00.obj`), then by command.
using Outcomes = std::map<std::string, CommandOutcomes>;

/// The commands that are run on each file.
const std::vector<std::string>& outcome_commands();

/// Runs every command on the file, `smooth` with these options. Checks that the output is complete,
/// or absent after an error, and that no run takes much time or memory.
CommandOutcomes outcomes_of(const std::string& path, const Words& smooth_options = {});

/// Reads `tests/malformed_outcomes.tsv`. A line has a file, commands, their exit code and their
/// message.
Outcomes expected_outcomes();

/// The text of such a table for other outcomes; commands that end alike share a line.
std::string outcomes_text(const Outcomes& outcomes);

/// The path of `tests/malformed_outcomes.tsv`.
std::string outcomes_path();

}  // namespace ibmfair::test
