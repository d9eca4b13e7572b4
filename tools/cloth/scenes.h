// The table of scenes, [W07] section 3.1: a square sheet of side 1 m, seen with y upwards.
#pragma once

#include <span>
#include <string_view>

#include "cloth/integrators.h"
#include "ibmfair/picture/camera.h"
#include "ibmfair/shapes/subdivide.h"

namespace ibmfair::cloth {

inline constexpr double sheet_side = 1;  // metres

struct Scene {
  Plate plate;
  Surroundings surroundings;
  Points start;
};

struct SceneRow {
  std::string_view name;     ///< name on the command line
  std::string_view summary;  ///< one line
  Scene (*build)(const TriangleMesh& sheet);
  double seconds;    ///< until the sheet is at rest, or long enough to show its motion
  double time_step;  ///< seconds, for the implicit method
  View view;
};

std::span<const SceneRow> scenes();

/// The scene with that name; throws BadOption, whose message lists all names.
const SceneRow& scene(std::string_view name);

}  // namespace ibmfair::cloth
