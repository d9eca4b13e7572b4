// The option --stitch: closes the cracks of a mesh before its holes are filled.
#pragma once

#include <optional>

#include "commands/console.h"
#include "commands/length.h"
#include "commands/report/report.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// The file with its cracks closed (fill/stitch.h), whose sides may be `reach` apart. Says so on
/// the console, and adds to the report what was done. `topology`: of the file's mesh.
MeshFile stitch_cracks(const MeshFile& file, const Topology& topology,
                       const std::optional<Length>& reach, Report& report, const Console& console);

}  // namespace ibmfair::commands
