// JSON of a hole, for reports.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/fill/holes.h"

namespace ibmfair::commands {

/// The measures of a hole, without its vertices.
nlohmann::ordered_json hole_json(const Hole& hole);

}  // namespace ibmfair::commands
