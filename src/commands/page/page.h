// The report of a run as an HTML page: one self-contained file.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/page/scene.h"

namespace ibmfair::commands {

/// Throws BadOption if the program was built without the page (src/report_page/).
void require_page();

/// The page with this report and this scene, which have the format of src/report_page/payload.ts.
std::string page_text(const nlohmann::ordered_json& report, const std::optional<Scene>& scene);

}  // namespace ibmfair::commands
