// The scene of a mesh that the HTML page of a report shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/console.h"
#include "commands/report/report.h"
#include "commands/shared_options.h"
#include "ibmfair/page/scene.h"

namespace ibmfair::commands {

/// Whether one of the requested reports is an HTML page.
bool wants_page(const ReportOptions& options);

/// Builds the scene of `source` after adding lines for the holes and defects of its first topology,
/// and setting its places to those of the warnings. If the scene cannot be drawn, prints a note and
/// returns nothing.
std::optional<Scene> mesh_scene(SceneSource source, const std::vector<Warning>& warnings,
                                const Console& console);

}  // namespace ibmfair::commands
