#include "commands/stitch_cracks.h"

#include <fmt/format.h>

#include "commands/value_list.h"
#include "ibmfair/fill/holes.h"
#include "ibmfair/fill/stitch.h"

namespace ibmfair::commands {

MeshFile stitch_cracks(const MeshFile& file, const Topology& topology,
                       const std::optional<Length>& reach, Report& report, const Console& console) {
  const Points& X = file.mesh().X;
  const Cracks cracks = find_cracks(X, topology, find_holes(X, topology),
                                    reach ? std::optional(reach->on(X, topology)) : std::nullopt);
  EditedFile edited = stitched(file, cracks);
  for (const std::string& note : edited.notes) {
    console.note(note);
  }
  console.note(fmt::format("stitched {}, merged {}",
                           counted(cracks.t_junctions(), "T-junction", "T-junctions"),
                           counted(std::ssize(cracks.merged), "vertex", "vertices")));
  report.figures["stitched"] = {{"t_junctions", cracks.t_junctions()},
                                {"merged_vertices", cracks.merged.size()},
                                {"farthest_merged", cracks.farthest}};
  return std::move(edited.file);
}

}  // namespace ibmfair::commands
