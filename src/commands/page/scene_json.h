// A scene as a page reads it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/page/scene.h"

namespace ibmfair::commands {

/// All but the bytes of the arrays, as `Scene` of src/report_page/payload.ts.
nlohmann::ordered_json scene_json(const Scene& scene);

}  // namespace ibmfair::commands
