// What reading a file adds to a report.
#pragma once

#include "commands/report/report.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::commands {

/// Adds the warnings of the file, and the field `unknown_statements` if it has any.
void add_reading(const MeshFile& file, Report& report);

}  // namespace ibmfair::commands
