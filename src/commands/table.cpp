#include <array>

#include "commands/command.h"

namespace ibmfair::commands {

Runner declare_make(CLI::App& app);
Runner declare_smooth(CLI::App& app);

std::span<const Command> command_table() {
  static constexpr std::array table{
      Command{"smooth", "remove noise and ripples without shrinking", declare_smooth},
      Command{"make", "make a shape with known exact values", declare_make},
  };
  return table;
}

}  // namespace ibmfair::commands
