// Job files.
//
//     {"defaults": {"command": "smooth", "options": {"cutoff": "2%"}},
//      "jobs": [{"input": "scans/*.ply", "output": "fair/", "options": {"steps": 32}},
//               {"input": ["a.obj", "b.obj"], "output": "fair/{stem}.ply"},
//               {"command": "make", "shape": "torus", "output": "torus.off"}]}
//
// A job's keys are `command`, the command's arguments (`input` for IN, `output` for OUT, others in
// lower case) and `options`, whose keys are options without dashes: true for a flag, text or a
// number for others, a list where several values make one option; null and false take a default
// back. What `defaults` says holds for every job whose command knows it. `ibmfair COMMAND
// --dump-config` writes this format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "commands/batch/job.h"

namespace ibmfair::commands {

/// The jobs of a file with its defaults filled in, in order. Throws BadFile that names the file and
/// line and column, or job (counted from 1) and key; BadOption for a command that is not there.
std::vector<Job> parse_jobs(std::string_view text, const std::string& name);

/// Parses the jobs of a file, or of standard input where its name is `-`. Throws as `parse_jobs`.
std::vector<Job> read_jobs(const std::string& path);

}  // namespace ibmfair::commands
