// A scene in the format that the HTML page reads.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/page/scene.h"

namespace ibmfair::commands {

/// The scene as the type `Scene` of src/report_page/payload.ts, without the bytes of the arrays.
nlohmann::ordered_json scene_json(const Scene& scene);

}  // namespace ibmfair::commands
