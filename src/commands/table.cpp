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
      Command{"info", "tell what a mesh is: counts, topology, quality, energy, area, volume",
              declare_info},
      Command{"compare", "measure how far two meshes, or a mesh and an exact surface, are apart",
              declare_compare},
      Command{"view", "make a page that shows a mesh, or two, in a browser", declare_view},
      Command{"make", "make a shape with known exact values", declare_make},
      Command{"batch", "run commands over many files, resumable", declare_batch},
  };
  return table;
}

}  // namespace ibmfair::commands
