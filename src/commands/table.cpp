#include <array>

#include "commands/command.h"

namespace ibmfair::commands {

Runner declare_batch(CLI::App& app);
Runner declare_compare(CLI::App& app);
Runner declare_fill(CLI::App& app);
Runner declare_holes(CLI::App& app);
Runner declare_info(CLI::App& app);
Runner declare_make(CLI::App& app);
Runner declare_smooth(CLI::App& app);
Runner declare_view(CLI::App& app);

std::span<const Command> command_table() {
  static constexpr std::array table{
      Command{"smooth", "remove noise and ripples without shrinking", declare_smooth},
      Command{"fill", "close holes with patches that continue the surface", declare_fill},
      Command{"holes", "list the boundary loops of a mesh", declare_holes},
      Command{"info", "print counts, topology, quality, energy, area and volume of a mesh",
              declare_info},
      Command{"compare", "measure the distance of two meshes, or of a mesh and an exact surface",
              declare_compare},
      Command{"view", "make a page that shows one or two meshes in a browser", declare_view},
      Command{"make", "make a test shape whose exact values are known", declare_make},
      Command{"batch", "run commands over many files; can be resumed", declare_batch},
  };
  return table;
}

}  // namespace ibmfair::commands
