// What every page of a mesh shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/report/report.h"
#include "commands/shared_options.h"
#include "ibmfair/page/scene.h"

namespace ibmfair::commands {

/// Whether one of the reports is a page.
bool wants_page(const ReportOptions& options);

/// The lines and places that the first state of `source` has by itself, besides those it has
/// already: its holes, its defects, and what the warnings are about. The scene, if it can be drawn;
/// otherwise a note that it cannot.
std::optional<Scene> mesh_scene(SceneSource source, const std::vector<Warning>& warnings,
                                const Console& console);

}  // namespace ibmfair::commands
