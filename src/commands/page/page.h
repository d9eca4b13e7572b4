// The page by which people look at a run: one HTML file that needs nothing else.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/page/scene.h"

namespace ibmfair::commands {

/// Throws BadOption where the program was built without the page (src/report_page/).
void require_page();

/// The page with this report and this scene. src/report_page/payload.ts says what it takes.
std::string page_text(const nlohmann::ordered_json& report, const std::optional<Scene>& scene);

}  // namespace ibmfair::commands
