#include "commands/page/mesh_scene.h"

#include <algorithm>

#include "commands/report/report_formats.h"
#include "ibmfair/page/scene_lines.h"

namespace ibmfair::commands {

bool wants_page(const ReportOptions& options) {
  return std::any_of(options.paths.begin(), options.paths.end(), is_page);
}

std::optional<Scene> mesh_scene(SceneSource source, const std::vector<Warning>& warnings,
                                const Console& console) {
  const Points& X = *source.states.back().X;
  const Topology& topology = *source.states.front().topology;
  for (const auto& more : {hole_lines(X, find_holes(X, topology)), defect_outlines(X, topology)}) {
    source.lines.insert(source.lines.end(), more.begin(), more.end());
  }
  source.places = places_of(warnings);
  std::optional<Scene> scene = build_scene(source);
  if (!scene) {
    console.note(
        "the page shows no mesh: it has no triangles, or its size is beyond 1e15 or 1e-15");
  }
  return scene;
}

}  // namespace ibmfair::commands
