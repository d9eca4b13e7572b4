// How long the stages of a run took, for people.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ibmfair::commands {

using StageTimes = std::vector<std::pair<std::string, double>>;  ///< name and seconds

/// `  1.24 s: read 0.31, factor 0.62, ...`, ending in a line feed: the stages that took more than
/// one per cent of the sum, or all of them.
std::string stage_times_line(const StageTimes& stages, bool all);

}  // namespace ibmfair::commands
