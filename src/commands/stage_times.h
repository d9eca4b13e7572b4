// The times of the stages of a run as a line of text.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ibmfair::commands {

using StageTimes = std::vector<std::pair<std::string, double>>;  ///< name and seconds

/// A line such as `  1.24 s: read 0.31, factor 0.62, ...`, ending in a line feed, with the stages
/// that took more than 1 % of the sum; with all stages if `all`.
std::string stage_times_line(const StageTimes& stages, bool all);

}  // namespace ibmfair::commands
