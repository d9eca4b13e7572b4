// Job files.
//
//     {"defaults": {"command": "smooth", "options": {"cutoff": "2%"}},
//      "jobs": [{"input": "scans/*.ply", "output": "fair/", "options": {"steps": 32}},
//               {"input": ["a.obj", "b.obj"], "output": "fair/{stem}.ply"},
//               {"command": "make", "shape": "torus", "output": "torus.off"}]}
//
// A job's keys are `command`, the command's arguments (`input` for IN, `output` for OUT, others in
// lower case) and `options`, an object whose keys are options without dashes. The value of a flag
// is true; the value of another option is a text or a number, or a list if the option takes several
// values. null and false remove a default. An entry of `defaults` applies to every job whose
// command has this argument or option. `ibmfair COMMAND --dump-config` writes this format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "commands/batch/job.h"

namespace ibmfair::commands {

/// Parses a job file and returns its jobs in order, with the defaults filled in. Throws BadFile
/// whose message names the file and either line and column, or job (counted from 1) and key; throws
/// BadOption for a command that does not exist.
std::vector<Job> parse_jobs(std::string_view text, const std::string& name);

/// Reads the jobs of a file, or of standard input if `path` is `-`. Throws like `parse_jobs`.
std::vector<Job> read_jobs(const std::string& path);

}  // namespace ibmfair::commands
