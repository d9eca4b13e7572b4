#include "commands/stage_times.h"

#include <fmt/format.h>

namespace ibmfair::commands {

std::string stage_times_line(const StageTimes& stages, bool all) {
  constexpr double share_to_mention = 0.01;
  double sum = 0;
  for (const auto& stage : stages) {
    sum += stage.second;
  }
  std::string list;
  for (const auto& stage : stages) {
    if (all || stage.second > share_to_mention * sum) {
      list += fmt::format("{}{} {:.2g}", list.empty() ? "" : ", ", stage.first, stage.second);
    }
  }
  return fmt::format("  {:.3g} s: {}\n", sum, list);
}

}  // namespace ibmfair::commands
